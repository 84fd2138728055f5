#version 330 core
// Light and dark in turn, so that it shows on any colour; the turns walk with `phase`.
out vec4 colour;
uniform float phase;    // 0..1
uniform float turns;    // screen pixels of a light and a dark piece

void main() {
    float place = fract((gl_FragCoord.x - gl_FragCoord.y) / turns + phase);
    colour = vec4(vec3(place < 0.5 ? 0.0 : 1.0), 1.0);
}
