#version 330
// The sky of engine/terrain/daylight.py; below the horizon, where no land is yet, the haze before it.
in vec3 way;
uniform vec3 sun;
out vec4 colour;

void main() {
    vec3 d = normalize(way);
    float k = exp(-4.5 * max(d.z, 0.0));
    float near = max(0.0, dot(d, sun));
    float glow = 0.16 * pow(near, 6.0) + 0.5 * pow(near, 64.0);
    vec3 v = 0.86 * vec3(0.17 + 0.55 * k + glow, 0.31 + 0.42 * k + 0.74 * glow, 0.62 + 0.18 * k + 0.42 * glow);
    v = clamp(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0);
    colour = vec4(pow(v, vec3(1.0 / 2.2)), 1.0);
}
