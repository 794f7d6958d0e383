#include "assets_baked/bake/loaders/gltf_attribute.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::bake {

namespace {

/// The integer that stands for 1.
double one_of(ComponentType type) {
    switch (type) {
    case ComponentType::I8:
        return 127.0;
    case ComponentType::U8:
        return 255.0;
    case ComponentType::I16:
        return 32767.0;
    case ComponentType::U16:
        return 65535.0;
    case ComponentType::U32:
        return 4294967295.0;
    default:
        return 1.0;
    }
}

} // namespace

GltfAttribute::GltfAttribute(const GltfModel& model, GltfBuffers& buffers, std::size_t accessor)
    : place_(fmt::format("accessors[{}]", accessor)) {
    const GltfAccessor& source = model.accessors[accessor];
    count_ = source.count;
    components_ = source.components;
    type_ = source.type;
    normalised_ = source.normalised;
    stride_ = static_cast<std::size_t>(source.byte_stride);
    if (source.view) {
        bytes_ = buffers.view(*source.view).subspan(static_cast<std::size_t>(source.byte_offset));
    }
    if (source.sparse) {
        sparse_elements_ = buffers.sparse_elements(accessor);
        sparse_values_ = buffers.view(source.sparse->values_view)
                             .subspan(static_cast<std::size_t>(source.sparse->values_offset));
    }
}

GltfAttribute::GltfAttribute(const GltfModel& model, std::size_t accessor,
                             std::shared_ptr<const std::vector<double>> numbers, std::size_t components)
    : place_(fmt::format("accessors[{}]", accessor)), count_(numbers->size() / components),
      components_(components), type_(model.accessors[accessor].type),
      normalised_(model.accessors[accessor].normalised), numbers_(std::move(numbers)) {}

void GltfAttribute::normalise() {
    normalised_ = true;
}

double GltfAttribute::raw(std::size_t element, std::size_t component) const {
    if (element >= count_ || component >= components_) {
        refuse_contradiction("{}: element {} is out of range, there are {}", place_, element, count_);
    }
    if (numbers_) {
        return (*numbers_)[element * components_ + component];
    }
    const std::size_t size = size_of(type_);
    if (!sparse_elements_.empty()) {
        const auto found = std::lower_bound(sparse_elements_.begin(), sparse_elements_.end(), element);
        if (found != sparse_elements_.end() && *found == element) {
            const auto row = static_cast<std::size_t>(found - sparse_elements_.begin());
            return number_at(sparse_values_, (row * components_ + component) * size, type_);
        }
    }
    return bytes_.empty() ? 0.0 : number_at(bytes_, element * stride_ + component * size, type_);
}

double GltfAttribute::value(std::size_t element, std::size_t component) const {
    const double number = raw(element, component);
    if (!std::isfinite(number)) {
        refuse_damage("{}: element {} is not a finite number", place_, element);
    }
    return normalised_ && type_ != ComponentType::F32 ? std::max(number / one_of(type_), -1.0) : number;
}

glm::dvec2 GltfAttribute::vec2(std::size_t element) const {
    return {value(element, 0), value(element, 1)};
}

glm::dvec3 GltfAttribute::vec3(std::size_t element) const {
    return {value(element, 0), value(element, 1), value(element, 2)};
}

std::uint32_t GltfAttribute::whole(std::size_t element, std::size_t component) const {
    return static_cast<std::uint32_t>(std::clamp(raw(element, component), 0.0, 4294967295.0));
}

} // namespace frustumscreen::bake
