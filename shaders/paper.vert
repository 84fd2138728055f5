#version 330 core
// One triangle over the whole screen.
out vec2 screen;  // framebuffer pixels, y down
uniform vec2 size;

void main() {
    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    screen = vec2(corner.x, 1.0 - corner.y) * size;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
