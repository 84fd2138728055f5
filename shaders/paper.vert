#version 330 core
// A cell of paper, as canvas.vert lays it; what changes evenly over it is worked out at its corners.
in vec4 cell;       // screen x, y of its corner; screen pixels along a side
out vec4 squares;   // coarse (xy) and fine (zw) squares from where the pattern begins
out vec4 inner;     // screen pixels, before turning, from the frame's left, top, right and bottom inwards
uniform vec2 size;      // of the screen, pixels
uniform float rim;      // pixels that are drawn around it
uniform vec4 turn;      // rows of the matrix from canvas to screen directions
uniform vec4 inverse;   // rows of the matrix from screen to canvas directions
uniform vec2 pitch;     // coarse and fine squares a screen pixel
uniform vec4 phase;     // where the centre lies in the coarse (xy) and fine (zw) pattern, in squares
uniform vec4 frame;     // left, top, right, bottom of the frame seen from the centre, screen pixels before turning

void main() {
    vec2 d = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * cell.z;
    vec2 place = cell.xy + vec2(dot(turn.xy, d), dot(turn.zw, d));
    vec2 from = place - 0.5 * size;
    vec2 at = vec2(dot(inverse.xy, from), dot(inverse.zw, from));
    squares = vec4(at * pitch.x + phase.xy, at * pitch.y + phase.zw);
    inner = vec4(at - frame.xy, frame.zw - at);
    vec2 part = (place + rim) / (size + 2.0 * rim);
    gl_Position = vec4(part.x * 2.0 - 1.0, 1.0 - part.y * 2.0, 0.0, 1.0);
}
