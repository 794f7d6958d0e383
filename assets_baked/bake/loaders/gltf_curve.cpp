#include "assets_baked/bake/loaders/gltf_curve.h"

#include "assets_baked/bake/loaders/gltf_attribute.h"
#include "assets_baked/bake/loaders/refusal.h"

#include <cmath>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr double min_quaternion = 1e-3; ///< as a pack allows it

/// A number of the file as a curve holds it; refuses what 32 bits cannot hold.
float in_32_bits(double number, const std::string& place, std::size_t element) {
    const auto value = static_cast<float>(number);
    if (!std::isfinite(value)) {
        refuse_damage("{}: element {} is out of range", place, element);
    }
    return value;
}

std::vector<float> times_of(const GltfAttribute& input, const std::string& place) {
    if (input.components() != 1 || input.type() != ComponentType::F32) {
        refuse_contradiction("{}.input: {} does not have the form of times, one float each", place,
                             input.place());
    }
    std::vector<float> times;
    for (std::size_t k = 0; k < input.count(); ++k) {
        const float time = in_32_bits(input.value(k, 0), input.place(), k);
        if (time < 0.0F) {
            refuse_contradiction("{}.input: key {} is at {} s, but an animation begins at 0 s", place, k,
                                 time);
        }
        if (!times.empty() && !(time > times.back())) {
            refuse_contradiction("{}.input: key {} is at {} s, after one at {} s; times must rise", place, k,
                                 time, times.back());
        }
        times.push_back(time);
    }
    return times;
}

/// Rotations may be integers: fractions of 1 (glTF 2.0, 3.11, table of the allowed types).
void check_values(const GltfAttribute& output, const GltfSampler& sampler, GltfPath path) {
    const bool turns = path == GltfPath::Rotation;
    const bool is_fraction = turns && output.normalised() && output.type() != ComponentType::U32;
    if (output.components() != (turns ? 4 : 3) || (output.type() != ComponentType::F32 && !is_fraction)) {
        refuse_contradiction("{}.output: {} does not have the form of {}", sampler.place, output.place(),
                             turns ? "rotations, four floats or normalised integers" : "three floats");
    }
}

void check_count(const GltfAttribute& output, const GltfSampler& sampler, std::size_t keys) {
    const std::size_t each = sampler.interpolation == world::Interpolation::CubicSpline ? 3 : 1;
    if (output.count() != each * keys) {
        refuse_contradiction("{}.output: {} values for {} times; {} for each are expected", sampler.place,
                             output.count(), keys, each);
    }
}

/// The value of a rotation's key: a tangent may have any length.
glm::vec4 checked_rotation(const glm::vec4& value, const GltfSampler& sampler, std::size_t element) {
    const bool is_spline = sampler.interpolation == world::Interpolation::CubicSpline;
    if (is_spline && element % 3 != 1) {
        return value;
    }
    const double length = glm::length(glm::dvec4(value));
    if (length < min_quaternion) {
        refuse_contradiction("{}.output: element {} is not a rotation: its length is zero", sampler.place,
                             element);
    }
    return is_spline ? value : glm::vec4(glm::dvec4(value) / length);
}

} // namespace

world::Curve gltf_curve_of(const GltfModel& model, GltfBuffers& buffers, const GltfSampler& sampler,
                           GltfPath path) {
    const GltfAttribute input(model, buffers, sampler.input);
    const GltfAttribute output(model, buffers, sampler.output);
    check_values(output, sampler, path);
    check_count(output, sampler, input.count());
    world::Curve curve{
        .interpolation = sampler.interpolation, .times_s = times_of(input, sampler.place), .values = {}};
    for (std::size_t k = 0; k < output.count(); ++k) {
        glm::vec4 value(0.0F);
        for (std::size_t i = 0; i < output.components(); ++i) {
            value[static_cast<int>(i)] = in_32_bits(output.value(k, i), output.place(), k);
        }
        curve.values.push_back(path == GltfPath::Rotation ? checked_rotation(value, sampler, k) : value);
    }
    return curve;
}

} // namespace frustumscreen::bake
