#version 330 core
// A sheet of the canvas anywhere on the screen.
out vec2 own;
uniform vec2 corner;    // screen pixels
uniform vec4 sides;     // its upper side and its left one, screen pixels
uniform vec2 size;      // of the screen, pixels

void main() {
    own = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
    vec2 at = corner + own.x * sides.xy + own.y * sides.zw;
    gl_Position = vec4(at.x / size.x * 2.0 - 1.0, 1.0 - at.y / size.y * 2.0, 0.0, 1.0);
}
