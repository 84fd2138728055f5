#version 330
// What the eye makes of the sky.
in vec3 light;
out vec4 colour;

// Within 0.7 of 255 of `developed` in engine/terrain/land_picture.py, of the root of light; powers would be dear.
void main() {
    vec3 v = sqrt(max(light, 0.0));
    v *= (v * (7.13764 + v * 38.54967) - 0.23419) / (1.0 + v * (7.23121 + v * (1.92895 + v * 39.79344)));
    colour = vec4(v, 1.0);
}
