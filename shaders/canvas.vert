#version 330 core
// A cell of the canvas; one instance a cell.  Shared by the three passes: paper, whole tiles, tiles that fade.
in vec4 cell;       // screen x, y of its corner; screen pixels along a side; weight of the tile over its ancestor
in vec4 source;     // its layer in the array, the ancestor's, the tile's corner in the ancestor (0..1); layer < 0: none
in float span;      // the tile's side in the ancestor, 0..1
out vec2 own;
out vec2 old;
flat out vec3 pick; // layer, ancestor's layer, weight
uniform vec2 size;
uniform float rim;  // pixels that are drawn around the screen
uniform vec4 turn;  // rows of the matrix from canvas to screen directions

void main() {
    vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
    vec2 d = corner * cell.z;
    vec2 at = cell.xy + vec2(dot(turn.xy, d), dot(turn.zw, d));
    own = corner;
    old = source.zw + corner * span;
    pick = vec3(source.xy, cell.w);
    vec2 part = (at + rim) / (size + 2.0 * rim);
    gl_Position = vec4(part.x * 2.0 - 1.0, 1.0 - part.y * 2.0, 0.0, 1.0);
}
