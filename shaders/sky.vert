#version 330
// The whole picture, at the far end: the sky of engine/terrain/daylight.py; below the horizon, where no land is yet, the
// haze before it.
in vec2 at;  // -1..1
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;
uniform vec2 lens;
uniform vec3 sun;
out vec3 light;

void main() {
    vec3 d = normalize(forward + right * at.x / lens.x + up * at.y / lens.y);
    float k = exp(-4.5 * max(d.z, 0.0));
    float near = max(0.0, dot(d, sun));
    float glow = 0.16 * pow(near, 6.0) + 0.5 * pow(near, 64.0);
    light = 0.86 * vec3(0.17 + 0.55 * k + glow, 0.31 + 0.42 * k + 0.74 * glow, 0.62 + 0.18 * k + 0.42 * glow);
    gl_Position = vec4(at, 0.999999, 1.0);
}
