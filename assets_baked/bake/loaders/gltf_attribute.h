/// One accessor, read element by element from its bytes: strides, normalised integers and sparse replacements as in
/// glTF 2.0, 3.6.2. Only requested elements are unpacked, so that a small file cannot make large arrays.
///
/// Lifetime  points into GltfBuffers.
/// Errors    throws Refusal: an element that is not finite, sparse indices out of order.
#pragma once

#include "assets_baked/bake/loaders/gltf_buffers.h"
#include "assets_baked/bake/loaders/gltf_model.h"

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::bake {

class GltfAttribute {
public:
    GltfAttribute(const GltfModel& model, GltfBuffers& buffers, std::size_t accessor);
    /// Uses numbers decoded elsewhere, `components` for each element, in place of the accessor's own.
    GltfAttribute(const GltfModel& model, std::size_t accessor,
                  std::shared_ptr<const std::vector<double>> numbers, std::size_t components);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t components() const { return components_; }
    [[nodiscard]] ComponentType type() const { return type_; }
    [[nodiscard]] bool normalised() const { return normalised_; }
    /// True if the elements come from data; without data a file may claim any number of zeros.
    [[nodiscard]] bool has_data() const { return !bytes_.empty() || numbers_ != nullptr; }
    [[nodiscard]] const std::string& place() const { return place_; }

    /// Treats integers as fractions even if the file does not mark them so (colours, weights).
    void normalise();

    [[nodiscard]] double value(std::size_t element, std::size_t component) const;
    [[nodiscard]] glm::dvec2 vec2(std::size_t element) const;
    [[nodiscard]] glm::dvec3 vec3(std::size_t element) const;
    /// The element as an integer; for unsigned types.
    [[nodiscard]] std::uint32_t whole(std::size_t element, std::size_t component = 0) const;

private:
    [[nodiscard]] double raw(std::size_t element, std::size_t component) const;

    std::string place_;
    std::size_t count_ = 0;
    std::size_t components_ = 1;
    ComponentType type_ = ComponentType::F32;
    bool normalised_ = false;
    ByteView bytes_; ///< from the first element on; empty: zeros
    std::size_t stride_ = 0;
    std::span<const std::uint32_t> sparse_elements_; ///< ascending
    ByteView sparse_values_;
    std::shared_ptr<const std::vector<double>> numbers_;
};

} // namespace frustumscreen::bake
