#version 330
// A picture over all of the canvas.
in vec2 at;
out vec2 place;

void main() {
    place = at * 0.5 + 0.5;
    gl_Position = vec4(at, 0.0, 1.0);
}
