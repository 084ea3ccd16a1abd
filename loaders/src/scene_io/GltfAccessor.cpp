#include "GltfAccessor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

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

/// Elements in a buffer, all of them inside.
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

/// The elements of an accessor, whole or replaced by sparse ones.
class AccessorElements {
 public:
  static Result<AccessorElements> create(const GltfFile& file, int index, std::size_t components);

  std::size_t count() const { return count_; }
  /// Null: zeros.
  const std::uint8_t* at(std::uint32_t index) const {
    const auto sparse = std::lower_bound(replaced_.begin(), replaced_.end(), Replaced{index, nullptr});
    if (sparse != replaced_.end() && sparse->index == index) return sparse->bytes;
    return elements_.first ? elements_.at(index) : nullptr;
  }

 private:
  struct Replaced {
    std::uint32_t index;
    const std::uint8_t* bytes;

    bool operator<(const Replaced& other) const { return index < other.index; }
  };

  Result<void> readSparse(const GltfFile& file, const tinygltf::Accessor& accessor, std::size_t size,
                          const std::string& name);

  std::size_t count_ = 0;
  Elements elements_{};
  std::vector<Replaced> replaced_{};  ///< by index
};

Result<AccessorElements> AccessorElements::create(const GltfFile& file, int index, std::size_t components) {
  WEFT_TRY(const tinygltf::Accessor* accessor, accessorAt(file, index));
  const std::string name = nameOf(index);
  WEFT_TRY(const std::size_t actual, componentsOf(file, index));
  if (actual != components)
    return file.fail(name + " does not have " + std::to_string(components) + " components");
  const std::size_t size = components * componentSize(accessor->componentType);
  AccessorElements elements;
  elements.count_ = accessor->count;
  if (accessor->bufferView >= 0) {
    WEFT_TRY(elements.elements_,
             elementsIn(file, accessor->bufferView, accessor->byteOffset, accessor->count, size, name));
  } else if (accessor->count == 0 || accessor->count > std::numeric_limits<std::uint32_t>::max()) {
    return file.fail(name + " is empty or too large");
  }
  if (accessor->sparse.isSparse) WEFT_TRY_VOID(elements.readSparse(file, *accessor, size, name));
  return elements;
}

Result<void> AccessorElements::readSparse(const GltfFile& file, const tinygltf::Accessor& accessor,
                                          std::size_t size, const std::string& name) {
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  WEFT_TRY(const Elements indices,
           elementsIn(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                      count, componentSize(sparse.indices.componentType), name));
  WEFT_TRY(const Elements values,
           elementsIn(file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                      count, size, name));
  for (std::size_t i = 0; i < count; ++i) {
    WEFT_TRY(const std::uint32_t target, unsignedAt(file, indices.at(i), sparse.indices.componentType, name));
    if (target >= count_) return file.fail(name + " replaces an element that it does not have");
    replaced_.push_back({target, values.at(i)});
  }
  std::stable_sort(replaced_.begin(), replaced_.end());
  return {};
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

Result<std::size_t> countOf(const GltfFile& file, int accessor) {
  WEFT_TRY(const std::size_t components, componentsOf(file, accessor));
  WEFT_TRY(const AccessorElements elements, AccessorElements::create(file, accessor, components));
  return elements.count();
}

Result<std::vector<float>> readFloats(const GltfFile& file, int index, std::size_t components,
                                      const ElementChoice& choice) {
  WEFT_TRY(const AccessorElements elements, AccessorElements::create(file, index, components));
  const tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(index)];
  const std::size_t size = componentSize(accessor.componentType);
  const std::size_t count = choice ? choice->size() : elements.count();
  WEFT_TRY_VOID(file.checkMemory(count * components * sizeof(float), nameOf(index)));
  std::vector<float> values(count * components);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* place = elements.at(choice ? (*choice)[i] : static_cast<std::uint32_t>(i));
    for (std::size_t k = 0; place && k < components; ++k) {
      const float value = componentToFloat(place + k * size, accessor.componentType, accessor.normalized);
      if (!std::isfinite(value)) return file.fail(nameOf(index) + " holds a value that is not finite");
      values[i * components + k] = value;
    }
  }
  return values;
}

Result<std::vector<std::uint32_t>> readIndices(const GltfFile& file, int index) {
  WEFT_TRY(const AccessorElements elements, AccessorElements::create(file, index, 1));
  WEFT_TRY_VOID(file.checkMemory(elements.count() * sizeof(std::uint32_t), nameOf(index)));
  const int type = file.model.accessors[static_cast<std::size_t>(index)].componentType;
  constexpr std::uint8_t zeros[4] = {};
  std::vector<std::uint32_t> indices(elements.count());
  for (std::uint32_t i = 0; i < indices.size(); ++i) {
    const std::uint8_t* place = elements.at(i);
    WEFT_TRY(indices[i], unsignedAt(file, place ? place : zeros, type, nameOf(index)));
  }
  return indices;
}

bool isFinite(const glm::mat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row])) return false;
  return true;
}

}  // namespace weft
