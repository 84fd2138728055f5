#version 330 core
// Premultiplied paint: the magnified ancestor until the finer tile has come, then a short fade.
in vec2 own;
in vec2 old;
flat in vec3 pick;
out vec4 colour;
uniform sampler2DArray tiles;

void main() {
    vec4 fine = pick.x < 0.0 ? vec4(0.0) : texture(tiles, vec3(own, pick.x));
    vec4 coarse = pick.y < 0.0 ? vec4(0.0) : texture(tiles, vec3(old, pick.y));
    colour = mix(coarse, fine, pick.z);
}
