#include "assets_baked/bake/museum_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace frustumscreen::bake {

namespace {

constexpr float lift = 1.5e-3F; // a simplified surface may be this far below its source
constexpr float dome_reach = 1.5F;

float radiance(const glm::vec3& direction) {
    static const glm::vec3 key = glm::normalize(glm::vec3(-0.45F, -0.60F, 0.80F));
    const float dome = 0.42F + 0.30F * direction.z;
    const float towards_key = std::fmax(glm::dot(direction, key), 0.0F);
    const float lobe = towards_key * towards_key * towards_key * towards_key;
    return dome + 1.1F * lobe;
}

/// Cosine-weighted directions about +Z, even over the hemisphere (Hammersley points).
std::vector<glm::vec3> cosine_directions(int count) {
    std::vector<glm::vec3> directions;
    for (int k = 0; k < count; ++k) {
        std::uint32_t bits = static_cast<std::uint32_t>(k);
        float inverse = 0.0F;
        for (float digit = 0.5F; bits != 0; bits >>= 1, digit *= 0.5F) {
            inverse += digit * static_cast<float>(bits & 1U);
        }
        const float radius = std::sqrt((static_cast<float>(k) + 0.5F) / static_cast<float>(count));
        const float angle = 2.0F * std::numbers::pi_v<float> * inverse;
        directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                std::sqrt(std::fmax(0.0F, 1.0F - radius * radius)));
    }
    return directions;
}

/// Turns directions about +Z to those about a normal.
class Tangents {
public:
    explicit Tangents(const glm::vec3& normal) : normal_(normal) {
        const glm::vec3 side = std::abs(normal.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
        tangent_ = glm::normalize(glm::cross(side, normal));
        bitangent_ = glm::cross(normal, tangent_);
    }
    [[nodiscard]] glm::vec3 turned(const glm::vec3& d) const {
        return tangent_ * d.x + bitangent_ * d.y + normal_ * d.z;
    }

private:
    glm::vec3 normal_, tangent_, bitangent_;
};

} // namespace

MuseumLight::MuseumLight(const SourceScene& source) : source_(source), directions_(cosine_directions(96)) {}

float MuseumLight::at(const glm::vec3& place, const glm::vec3& normal) const {
    const Tangents tangents(normal);
    const glm::vec3 origin = place + normal * lift;
    float sum = 0.0F;
    for (const glm::vec3& d : directions_) {
        const glm::vec3 direction = tangents.turned(d);
        if (direction.z < 0.0F) {
            sum += 0.10F; // light reflected by the dark table
            continue;
        }
        if (!source_.occluded(origin, direction, 0.0F, dome_reach)) {
            sum += radiance(direction);
        } else {
            sum += 0.12F; // approximates light that bounced once; keeps hollows readable
        }
    }
    return sum / static_cast<float>(directions_.size());
}

bool MuseumLight::is_hidden(const glm::vec3& place, const glm::vec3& normal) const {
    const Tangents tangents(normal);
    const glm::vec3 origin = place + normal * lift;
    return std::all_of(directions_.begin(), directions_.end(), [&](const glm::vec3& d) {
        return source_.occluded(origin, tangents.turned(d), 0.0F, dome_reach);
    });
}

} // namespace frustumscreen::bake
