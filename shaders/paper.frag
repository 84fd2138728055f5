#version 330 core
// The paper under cells that are not covered: a quiet chequerboard inside the frame, a plain dark desk outside.
in vec2 own;
in vec2 old;
flat in vec3 pick;
out vec4 colour;
uniform vec2 size;      // of the screen, pixels
uniform vec4 inverse;   // rows of the matrix from screen to canvas directions
uniform vec2 pitch;     // coarse and fine squares a screen pixel
uniform vec4 phase;     // where the centre lies in the coarse (xy) and fine (zw) pattern, in squares
uniform float blend;    // 0 shows the coarse squares, 1 the fine ones
uniform vec4 frame;     // left, top, right, bottom of the frame seen from the centre, screen pixels before turning
uniform vec3 light;
uniform vec3 dark;

float squares(vec2 at) {
    vec2 half_way = step(0.5, fract(at * 0.5));
    return abs(half_way.x - half_way.y);
}

void main() {
    vec2 d = vec2(gl_FragCoord.x, size.y - gl_FragCoord.y) - 0.5 * size;
    vec2 at = vec2(dot(inverse.xy, d), dot(inverse.zw, d));
    float s = mix(squares(at * pitch.x + phase.xy), squares(at * pitch.y + phase.zw), blend);
    vec2 inner = min(at - frame.xy, frame.zw - at);
    float inside = clamp(min(inner.x, inner.y) + 0.5, 0.0, 1.0);
    colour = vec4(mix(dark, light - vec3(0.045) * s, inside), 1.0);
}
