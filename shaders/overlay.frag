#version 330 core
// The panels, premultiplied, pixel for pixel.
in vec2 at;
out vec4 colour;
uniform sampler2D picture;

void main() {
    colour = textureLod(picture, at, 0.0);
}
