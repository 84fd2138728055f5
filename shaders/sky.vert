#version 330
// The whole picture, at the far end.
in vec2 at;  // -1..1
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;
uniform vec2 lens;
out vec3 way;

void main() {
    way = forward + right * at.x / lens.x + up * at.y / lens.y;
    gl_Position = vec4(at, 0.999999, 1.0);
}
