#version 330
// How much of the picture at rest, whose first row is the uppermost, has come over the one while the eye moves.
in vec2 place;
uniform sampler2D moving;
uniform sampler2D still;
uniform float part;
uniform vec2 reach;  // of the still picture that is seen
out vec4 colour;

void main() {
    vec4 rests = textureLod(still, vec2(place.x, 1.0 - place.y) * reach, 0.0);
    colour = mix(textureLod(moving, place, 0.0), rests, part);
}
