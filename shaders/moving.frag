#version 330
// The picture while the eye moves.
in vec2 place;
uniform sampler2D moving;
out vec4 colour;

void main() {
    colour = textureLod(moving, place, 0.0);
}
