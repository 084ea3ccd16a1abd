#include "GltfAccessor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr std::size_t kMostElements = 100'000'000;

std::size_t componentSize(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return 8;
    default:
      return 4;
  }
}

std::string nameOf(int accessor) {
  return "accessor " + std::to_string(accessor);
}

/// Elements in a buffer, all of them inside; `first` null: zeros.
struct Elements {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;

  const std::uint8_t* at(std::size_t index) const { return first + index * stride; }
};

Result<Elements> elementsIn(const GltfFile& file, int view, std::size_t offset, std::size_t count,
                            std::size_t size, const std::string& name) {
  WEFT_TRY(const std::span<const std::uint8_t> bytes, viewBytes(file, view));
  const std::size_t given = file.model.bufferViews[static_cast<std::size_t>(view)].byteStride;
  const std::size_t stride = given == 0 ? size : given;
  const bool inside = count > 0 && offset <= bytes.size() && size <= bytes.size() - offset &&
                      count - 1 <= (bytes.size() - offset - size) / stride;
  if (!inside) return file.fail(name + " is empty or reaches beyond its buffer view");
  return Elements{bytes.data() + offset, stride, count};
}

Result<const tinygltf::Accessor*> accessorAt(const GltfFile& file, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.accessors.size())
    return file.fail(nameOf(index) + " does not exist");
  return &file.model.accessors[static_cast<std::size_t>(index)];
}

template <class Number>
Number load(const std::uint8_t* bytes) {
  Number value;  // the file need not align it
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// The whole number at an address, or what is wrong with its type.
Result<std::uint32_t> unsignedAt(const GltfFile& file, const std::uint8_t* bytes, int componentType,
                                 const std::string& name) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(bytes);
    default:
      return file.fail(name + " does not hold unsigned integers");
  }
}

/// For every element of an accessor where its bytes are; null: zeros.
Result<std::vector<const std::uint8_t*>> placesOf(const GltfFile& file, int index, std::size_t components) {
  WEFT_TRY(const tinygltf::Accessor* accessor, accessorAt(file, index));
  const std::string name = nameOf(index);
  WEFT_TRY(const std::size_t actual, componentsOf(file, index));
  if (actual != components)
    return file.fail(name + " does not have " + std::to_string(components) + " components");
  const std::size_t size = components * componentSize(accessor->componentType);
  std::vector<const std::uint8_t*> places;
  if (accessor->bufferView >= 0 || !accessor->sparse.isSparse) {
    WEFT_TRY(const Elements elements,
             elementsIn(file, accessor->bufferView, accessor->byteOffset, accessor->count, size, name));
    places.resize(elements.count);
    for (std::size_t i = 0; i < elements.count; ++i) places[i] = elements.at(i);
  } else {
    // No bytes stand behind these, so that a small file could ask for any amount of memory.
    if (accessor->count == 0 || accessor->count > kMostElements)
      return file.fail(name + " is empty or too large");
    places.resize(accessor->count);
  }
  if (!accessor->sparse.isSparse) return places;

  const auto& sparse = accessor->sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    return file.fail(name + " has a negative offset or count");
  const auto count = static_cast<std::size_t>(sparse.count);
  WEFT_TRY(const Elements indices,
           elementsIn(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                      count, componentSize(sparse.indices.componentType), name));
  WEFT_TRY(const Elements values,
           elementsIn(file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                      count, size, name));
  for (std::size_t i = 0; i < count; ++i) {
    WEFT_TRY(const std::uint32_t target, unsignedAt(file, indices.at(i), sparse.indices.componentType, name));
    if (target >= places.size()) return file.fail(name + " replaces an element that it does not have");
    places[target] = values.at(i);
  }
  return places;
}

template <class Integer>
float integerToFloat(const std::uint8_t* bytes, bool normalized) {
  const float value = static_cast<float>(load<Integer>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<Integer>::max()), -1.0f);
}

float componentToFloat(const std::uint8_t* bytes, int componentType, bool normalized) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integerToFloat<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integerToFloat<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integerToFloat<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integerToFloat<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return integerToFloat<std::int32_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integerToFloat<std::uint32_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return static_cast<float>(load<double>(bytes));
    default:
      return load<float>(bytes);
  }
}

}  // namespace

Result<std::size_t> componentsOf(const GltfFile& file, int accessor) {
  WEFT_TRY(const tinygltf::Accessor* found, accessorAt(file, accessor));
  return static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(found->type)));
}

Result<std::vector<float>> readFloats(const GltfFile& file, int index, std::size_t components) {
  WEFT_TRY(const std::vector<const std::uint8_t*> places, placesOf(file, index, components));
  const tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(index)];
  const std::size_t size = componentSize(accessor.componentType);
  std::vector<float> values;
  values.reserve(places.size() * components);
  for (const std::uint8_t* place : places)
    for (std::size_t k = 0; k < components; ++k) {
      const float value =
          place ? componentToFloat(place + k * size, accessor.componentType, accessor.normalized) : 0.0f;
      if (!std::isfinite(value)) return file.fail(nameOf(index) + " holds a value that is not finite");
      values.push_back(value);
    }
  return values;
}

Result<std::vector<std::uint32_t>> readIndices(const GltfFile& file, int index) {
  WEFT_TRY(const std::vector<const std::uint8_t*> places, placesOf(file, index, 1));
  const int type = file.model.accessors[static_cast<std::size_t>(index)].componentType;
  constexpr std::uint8_t zeros[4] = {};
  std::vector<std::uint32_t> indices(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    WEFT_TRY(indices[i], unsignedAt(file, places[i] ? places[i] : zeros, type, nameOf(index)));
  }
  return indices;
}

}  // namespace weft
