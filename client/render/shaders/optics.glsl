// Optics of a rough sea: facets whose slopes are Gaussian about a mean.

// What Gaussian facets of mean slope `mean` and given variance show to a view towards `v`.
struct Facets {
  float area;      // visible area per horizontal area
  vec2 slope;      // mean slope of what is visible
  float deviation; // of the slope along the view
};

// Smith's visible area for a Gaussian, and Stein's identity for the mean slope of what is seen.
Facets visible_facets(vec2 mean, vec3 variance, vec3 v) {
  vec2 spread = vec2(variance.x * v.x + variance.z * v.y, variance.z * v.x + variance.y * v.y);
  float deviation = sqrt(max(dot(spread, v.xy), 1e-7));
  float x = max((v.z - dot(mean, v.xy)) / deviation, -3.0);
  float density = exp(-0.5 * x * x) * 0.39894228;
  // Normal distribution function; Abramowitz & Stegun 26.2.17, error below 1e-7.
  float t = 1.0 / (1.0 + 0.2316419 * abs(x));
  float tail = density * t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  float probability = x > 0.0 ? 1.0 - tail : tail;
  float area = deviation * (x * probability + density);
  return Facets(max(area, 1e-4), mean - spread * (probability / max(area, 1e-4)), deviation);
}

float fresnel_exact(float cosine) {
  const float n2 = 1.34 * 1.34;
  float g = sqrt(n2 - 1.0 + cosine * cosine);
  float a = (g - cosine) / (g + cosine);
  float b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
  return 0.5 * a * a * (1.0 + b * b);
}

// Mean over facets of slope deviation `s`: the exact law times Bruneton's ratio of rough to flat
// (Bruneton, Neyret & Holzschuch 2010), so that s = 0 is exact.
float fresnel_mean(float cosine, float s) {
  float grazing = max(1.0 - cosine, 0.03);
  float ratio = pow(grazing, 5.0 * (exp(-2.69 * s) - 1.0)) / (1.0 + 22.7 * s * sqrt(s));
  return 0.02111 + max(fresnel_exact(cosine) - 0.02111, 0.0) * ratio;
}

// Share of facets that lie below z = threshold in a Gaussian of given mean and deviation.
float share_below(float threshold, float mean, float deviation) {
  float x = (mean - threshold) / (1.41421356 * max(deviation, 1e-4));
  float t = 1.0 / (1.0 + 0.47047 * abs(x));
  float tail = t * (0.3480242 + t * (-0.0958798 + t * 0.7478556)) * exp(-x * x);
  return 0.5 * (x > 0.0 ? tail : 2.0 - tail);
}
