#version 330 core
// The magnified ancestor until the finer tile has come, then a short fade.  Layers below 0: there is none.
in vec2 own;
in vec2 old;
flat in vec3 pick;  // layer, ancestor's layer, weight of the tile over its ancestor
out vec4 colour;
uniform sampler2DArray tiles;

void main() {
    vec4 fine = pick.x < 0.0 ? vec4(0.0) : textureLod(tiles, vec3(own, pick.x), 0.0);
    vec4 coarse = pick.y < 0.0 ? vec4(0.0) : textureLod(tiles, vec3(old, pick.y), 0.0);
    colour = mix(coarse, fine, pick.z);
}
