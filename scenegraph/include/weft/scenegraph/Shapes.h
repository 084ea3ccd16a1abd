#pragma once

#include "weft/scenegraph/Mesh.h"

namespace weft {

/// A square of side 1 around the origin in the plane z = 0, facing +Z: its tangent frame is the
/// coordinate frame. (u, v) = (0, 0) at the upper left, (1, 1) at the lower right. `cells`: quads
/// along a side.
Mesh makePlane(int cells = 1);

/// A sphere of radius 1 around the origin with its poles on the Y axis. u runs 0..2 eastwards from
/// -Z, v 0..1 from the north pole to the south pole, so that texels are square at the equator; the
/// image is pinched at the poles. `rings`: quads from pole to pole, with twice as many around.
Mesh makeSphere(int rings = 64);

/// A square cloth of side 3 that fell on a ball of radius 0.6 around the origin, which stands on a
/// floor (y = -0.6): the usual way to look at a textile.
///
/// (u, v) are material coordinates, 0..1 along the sides, so that the image is as little stretched
/// as the cloth. The ball and the floor are not in the mesh and lie below it everywhere. The fall
/// is simulated: about 0.15 s, the same folds each time.
Mesh makeDrapedCloth();

}  // namespace weft
