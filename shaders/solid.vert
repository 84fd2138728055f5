#version 330
// An object made of a solid: its place within itself goes on, by which the solid is looked up.
in vec3 point;
in vec3 normal;
uniform mat3 turned;
uniform vec2 lens;  // of the picture's width and height
out vec3 inside;
out vec3 facing;
out vec3 place;

const float FAR = 6.4;

void main() {
    inside = point;
    facing = turned * normal;
    place = turned * point;
    float away = FAR - place.z;
    gl_Position = vec4(place.xy * lens, (away - FAR) * 0.5 * away / FAR, away);
}
