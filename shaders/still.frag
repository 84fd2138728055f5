#version 330
// The picture while the eye moves, and how much of the one at rest has come over it, whose first row is the uppermost.
in vec2 place;
uniform sampler2D moving;
uniform sampler2D still;
uniform float part;
uniform vec2 reach;  // of the still picture that is seen
out vec4 colour;

void main() {
    colour = texture(moving, place);
    if (part > 0.0)
        colour = mix(colour, texture(still, vec2(place.x, 1.0 - place.y) * reach), part);
}
