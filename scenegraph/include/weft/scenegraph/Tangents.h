#pragma once

#include "weft/scenegraph/Mesh.h"

namespace weft {

/// Flat: each triangle its own normal, as glTF asks for where a file has none; vertices are no
/// longer shared. Smooth: vertices at the same position share the mean of their triangles' normals,
/// weighted by angle.
enum class NormalKind { Flat, Smooth };

/// Replaces the normals. Needs positions and indices; keeps tangents and texture coordinates, which
/// may be empty. A triangle without area counts as facing +Z.
void generateNormals(Mesh& mesh, NormalKind kind = NormalKind::Flat);

/// Replaces the tangents by unit vectors along +U at right angles to the normals, as the material's
/// relief needs them (Mesh.h).
///
/// Needs all other attributes. Vertices that agree in position, normal and texture coordinates
/// share the mean of their triangles' directions, weighted by angle, so that results do not depend
/// on how a file splits vertices; where the image is mirrored from one triangle to the next the
/// vertex is split. Vertices whose texture coordinates span no area get some frame at right angles
/// to the normal. The same idea as MikkTSpace (Mikkelsen 2008), whose tangents differ a little at
/// vertices on mirrored seams.
void generateTangents(Mesh& mesh);

}  // namespace weft
