#version 330 core
// The canvas as it was drawn, lit by its own relief: the law of engine/light/lit_relief.py.
out vec4 colour;
uniform sampler2D picture;  // premultiplied, pixel for pixel, with a rim of RIM pixels around the screen
uniform sampler2D relief;   // its heights
uniform float slope;        // where the heights of the two neighbours of a pixel differ by one
uniform vec3 sun;           // to the right, downward, out of the screen; of length one
uniform float gloss;

float height(ivec2 at) {
    return texelFetch(relief, at, 0).r;
}

float power24(float x) {
    float x2 = x * x;
    float x4 = x2 * x2;
    float x8 = x4 * x4;
    return x8 * x8 * x8;
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy) + RIM;
    colour = texelFetch(picture, at, 0);
    vec2 g = slope * vec2(height(at + ivec2(1, 0)) - height(at - ivec2(1, 0)),
                          height(at - ivec2(0, 1)) - height(at + ivec2(0, 1)));
    if (g == vec2(0.0)) return;
    float up = inversesqrt(dot(g, g) + 1.0);
    float towards = (sun.z - dot(g, sun.xy)) * up;
    float bright = 1.0 + DIFFUSE * (max(towards, 0.0) / sun.z - 1.0);
    float shine = gloss * (power24(0.5 * max(towards + up, 0.0)) - power24(0.5 * (sun.z + 1.0)));
    colour.rgb = clamp(colour.rgb * bright + shine * colour.a, vec3(0.0), vec3(colour.a));
}
