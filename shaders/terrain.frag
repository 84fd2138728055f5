#version 330
// Lit ground, haze, and the sky that the farthest land becomes: the numbers of engine/terrain/daylight.py.
in vec2 place;
in vec3 way;
uniform sampler2D land;
uniform float haze;
uniform float horizon;
uniform float brightest;
uniform vec3 sun;
out vec4 colour;

vec3 sky(vec3 d) {
    float k = exp(-4.5 * max(d.z, 0.0));
    float near = max(0.0, dot(d, sun));
    float glow = 0.16 * pow(near, 6.0) + 0.5 * pow(near, 64.0);
    return vec3(0.17 + 0.55 * k + glow, 0.31 + 0.42 * k + 0.74 * glow, 0.62 + 0.18 * k + 0.42 * glow);
}

void main() {
    float t = length(way);
    vec3 d = way / t;
    vec3 v = texture(land, place).rgb;
    v *= v * brightest;
    float near = pow(max(0.0, dot(d, sun)), 5.0);
    v = mix(v, vec3(0.60 + 0.26 * near, 0.69 + 0.14 * near, 0.82), 1.0 - exp(-t / haze));
    float part = t / horizon;
    part *= part;
    v = mix(v, sky(d), 1.0 - exp(-6.0 * part * part));
    v *= 0.86;
    v = clamp(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0);
    colour = vec4(pow(v, vec3(1.0 / 2.2)), 1.0);
}
