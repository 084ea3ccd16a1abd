// The tangent frame at a pixel, from what mesh.vert interpolates.

struct TangentFrame {
  vec3 t;  // along the image's columns
  vec3 b;  // up the image
  vec3 n;
};

// Orthonormal, but not always right-handed (mirrored texture coordinates, back faces): go into it
// with dot products only. A tangent that is zero or along the normal is replaced by some other one.
// On a back face only the normal turns, since from behind the texture is seen in the mirror, and
// its relief with it.
TangentFrame tangentFrame(vec3 normal, vec3 tangent, float handedness, bool backFace) {
  TangentFrame frame;
  frame.n = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  frame.t = tangent - dot(tangent, frame.n) * frame.n;
  float squared = dot(frame.t, frame.t);
  if (!(squared > 1e-12)) {
    vec3 other = abs(frame.n.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    frame.t = other - dot(other, frame.n) * frame.n;
    squared = max(dot(frame.t, frame.t), 1e-30);
  }
  frame.t *= inversesqrt(squared);
  frame.b = handedness * cross(frame.n, frame.t);
  if (backFace) frame.n = -frame.n;
  return frame;
}

// A world-space direction in the frame: z is the cosine to the normal.
vec3 toFrame(TangentFrame frame, vec3 direction) {
  return vec3(dot(direction, frame.t), dot(direction, frame.b), dot(direction, frame.n));
}
