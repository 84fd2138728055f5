#version 330 core
// The heights of a tile, or of its magnified ancestor until it has come, as the picture is mixed of these.
in vec2 own;
in vec2 old;
flat in vec3 pick;  // layer, ancestor's layer, weight of the tile over its ancestor
out vec4 height;
uniform sampler2DArray tiles;
uniform vec4 weights; // of their channels, whose sum is the height

void main() {
    vec4 fine = pick.x < 0.0 ? vec4(0.0) : textureLod(tiles, vec3(own, pick.x), 0.0);
    vec4 coarse = pick.y < 0.0 ? vec4(0.0) : textureLod(tiles, vec3(old, pick.y), 0.0);
    height = vec4(dot(weights, mix(coarse, fine, pick.z)), 0.0, 0.0, 1.0);
}
