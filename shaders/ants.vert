#version 330 core
// A piece of the rim of what is selected: a strip along it, one point wide at any zoom; one instance a piece.
in vec4 line;           // x0, y0, x1, y1, pixels of the level from the corner that `origin` shows
uniform vec2 origin;    // screen pixels
uniform vec4 turn;      // rows of the matrix from pixels of the level to screen pixels
uniform vec2 size;      // of the screen, pixels
uniform float wide;     // screen pixels

void main() {
    vec2 a = origin + vec2(dot(turn.xy, line.xy), dot(turn.zw, line.xy));
    vec2 b = origin + vec2(dot(turn.xy, line.zw), dot(turn.zw, line.zw));
    vec2 along = normalize(b - a) * wide * 0.5;
    vec2 end = (gl_VertexID & 1) == 0 ? a - along : b + along;
    vec2 at = end + vec2(-along.y, along.x) * ((gl_VertexID >> 1) == 0 ? -1.0 : 1.0);
    gl_Position = vec4(at.x / size.x * 2.0 - 1.0, 1.0 - at.y / size.y * 2.0, 0.0, 1.0);
}
