#version 330
// Colour of the solid at this place of the object, in the light of one lamp, a bright room, and what it mirrors of both.
in vec3 inside;
in vec3 facing;
in vec3 place;
uniform sampler3D solid;
uniform float scale;
uniform float gloss;
out vec4 colour;

const vec3 LAMP = vec3(-0.46, 0.66, 0.60);
const float FAR = 6.4;

void main() {
    vec3 view = normalize(vec3(0.0, 0.0, FAR) - place);
    vec3 normal = normalize(facing);
    normal = dot(normal, view) < 0.0 ? -normal : normal;
    vec3 paint = texture(solid, inside * scale + 0.5).rgb;
    paint *= paint;
    float lamp = max(dot(normal, LAMP), 0.0);
    vec3 light = 1.65 * lamp * vec3(1.0, 0.94, 0.84)
        + (0.5 + 0.5 * normal.y) * vec3(0.42, 0.47, 0.54) + (0.5 - 0.5 * normal.y) * vec3(0.17, 0.15, 0.13);
    float edge = 0.045 + 0.75 * pow(1.0 - max(dot(normal, view), 0.0), 5.0);
    vec3 mirrored = reflect(-view, normal);
    float window = smoothstep(0.955, 0.985, dot(mirrored, LAMP));
    vec3 shown = paint * light + gloss * edge * (0.25 + 0.5 * max(mirrored.y, 0.0) + 7.0 * window);
    shown *= 0.72;
    shown = shown * (2.51 * shown + 0.03) / (shown * (2.43 * shown + 0.59) + 0.14);
    colour = vec4(pow(clamp(shown, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
