#version 330 core
// The paper under cells that are not covered: a quiet chequerboard inside the frame, a plain dark desk outside;
// paper of one colour has neither squares nor an end.
in vec4 squares;
in vec4 inner;
out vec4 colour;
uniform float blend;    // 0 shows the coarse squares, 1 the fine ones
uniform vec3 light;
uniform vec3 dark;
uniform float contrast; // of the squares

void main() {
    vec4 place = fract(0.5 * squares);
    bvec4 second = lessThan(place, vec4(0.5));
    float shade = (second.x != second.y ? 1.0 - blend : 0.0) + (second.z != second.w ? blend : 0.0);
    vec2 nearest = min(inner.xy, inner.zw);
    float inside = clamp(min(nearest.x, nearest.y) + 0.5, 0.0, 1.0);
    colour = vec4(mix(dark, light - contrast * shade, inside), 1.0);
}
