#version 330
// How much of the picture at rest, whose first row is the uppermost, has come over the one before.
in vec2 place;
uniform sampler2D under;
uniform sampler2D still;
uniform float part;
uniform vec2 reach;  // of the still picture that is seen
uniform vec4 lower;  // where the one before is looked up: times, and more
out vec4 colour;

void main() {
    vec4 rests = textureLod(still, vec2(place.x, 1.0 - place.y) * reach, 0.0);
    colour = mix(textureLod(under, place * lower.xy + lower.zw, 0.0), rests, part);
}
