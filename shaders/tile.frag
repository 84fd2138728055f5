#version 330 core
// Premultiplied paint of a tile.
in vec2 own;
in vec2 old;
flat in vec3 pick;  // layer, ancestor's layer, weight of the tile over its ancestor
out vec4 colour;
uniform sampler2DArray tiles;

void main() {
    colour = textureLod(tiles, vec3(own, pick.x), 0.0);
}
