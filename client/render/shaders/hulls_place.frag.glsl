// The mean of a picture's four samples, premultiplied, to be laid over the scene.
uniform sampler2DMS hulls;
out vec4 radiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  radiance = 0.25 * (texelFetch(hulls, pixel, 0) + texelFetch(hulls, pixel, 1) + texelFetch(hulls, pixel, 2) +
                     texelFetch(hulls, pixel, 3));
}
