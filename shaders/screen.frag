#version 330 core
// The window as it was drawn, in the colours that the screen is to be sent: by a table in three dimensions.
out vec4 colour;
uniform sampler2D picture;  // pixel for pixel
uniform sampler2D places;   // of each value of 8 bits in the table, 0..1
uniform sampler3D colours;

float place(float value) {
    return texelFetch(places, ivec2(int(value * 255.0 + 0.5), 0), 0).r;
}

void main() {
    vec3 seen = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    colour = vec4(textureLod(colours, vec3(place(seen.r), place(seen.g), place(seen.b)), 0.0).rgb, 1.0);
}
