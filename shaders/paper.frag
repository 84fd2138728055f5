#version 330 core
// The paper under cells that are not covered: a quiet chequerboard inside the frame, a plain dark desk outside.
in vec4 squares;
in vec4 inner;
out vec4 colour;
uniform float blend;    // 0 shows the coarse squares, 1 the fine ones
uniform float light;
uniform float dark;

const float CONTRAST = 0.045;

void main() {
    vec4 place = fract(0.5 * squares);
    bvec4 second = lessThan(place, vec4(0.5));
    float shade = (second.x != second.y ? 1.0 - blend : 0.0) + (second.z != second.w ? blend : 0.0);
    vec2 nearest = min(inner.xy, inner.zw);
    float inside = clamp(min(nearest.x, nearest.y) + 0.5, 0.0, 1.0);
    float grey = mix(dark, light - CONTRAST * shade, inside);
    colour = vec4(grey, grey, grey, 1.0);
}
