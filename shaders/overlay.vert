#version 330 core
// A rectangle of the panels' picture, laid where it was drawn; one instance a rectangle.
in vec4 box;            // left, top, right, bottom, screen pixels
out vec2 at;            // in the picture, 0..1
uniform vec2 size;      // of the screen, pixels

void main() {
    vec2 place = vec2((gl_VertexID & 1) == 0 ? box.x : box.z, (gl_VertexID >> 1) == 0 ? box.y : box.w) / size;
    at = vec2(place.x, 1.0 - place.y);
    gl_Position = vec4(at * 2.0 - 1.0, 0.0, 1.0);
}
