#include "assets_baked/bake/relief_layers.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr int rings = 3;            // how far a chart reaches beyond what it owns, texels
constexpr float best_margin = 0.1F; // cosine by which another direction may see a sample better
constexpr float steepest = 8.0F;    // largest step between linked neighbours, texels
constexpr int most_layers = 24;
constexpr float same_sheet = 0.5F; // texels
constexpr std::uint32_t none = 0xFFFFFFFFU;

glm::vec3 low_corner(const glm::vec3& box_size) {
    return {-box_size.x / 2.0F, -box_size.y / 2.0F, 0.0F};
}

/// Every crossing along one ray that a visitor can see.
void sample_ray(const LayerInput& input, const DirectionFrame& frame, int x, int y,
                std::vector<ReliefSample>& out) {
    const glm::vec3 low = low_corner(input.box_size);
    const glm::vec3 normal = frame.normal();
    glm::vec3 origin(0.0F);
    origin[frame.axis_u] = low[frame.axis_u] + (static_cast<float>(x) + 0.5F) * input.texel_box;
    origin[frame.axis_v] = low[frame.axis_v] + (static_cast<float>(y) + 0.5F) * input.texel_box;
    origin[frame.axis_n] =
        low[frame.axis_n] + (frame.sign > 0.0F ? input.box_size[frame.axis_n] + 0.01F : -0.01F);
    float near = 0.0F;
    float last_front = -1.0F; // the last crossing met, of each side
    float last_back = -1.0F;
    for (int layer = 0; layer < most_layers; ++layer) {
        const SurfaceHit hit = input.source.trace(origin, -normal, near, 4.0F);
        if (!hit.hit) {
            return;
        }
        near = hit.distance + 1e-5F;
        glm::vec3 n = hit.normal;
        float facing = glm::dot(n, normal);
        // Sheets closer than a part of a texel count as one: triangle soups and coplanar repetitions have
        // many.
        float& last = facing < 0.0F ? last_back : last_front;
        const bool repeated = last >= 0.0F && hit.distance - last < same_sheet * input.texel_box;
        last = hit.distance;
        if (facing < 0.0F) {
            n = -n; // two-sided: the back is kept where a visitor sees it
            facing = -facing;
        }
        if (facing < 0.03F || repeated) {
            continue;
        }
        const SurfaceHit seen = input.visible_scene.nearest(hit.point, 2.0F * input.texel_box);
        if (!seen.hit || glm::dot(seen.normal, n) < 0.0F) {
            continue;
        }
        float best = 0.0F;
        for (const glm::vec3& other : input.normals) {
            best = std::fmax(best, glm::dot(n, other));
        }
        const glm::vec3 colour =
            glm::clamp(glm::vec3(input.source.colour(hit)), glm::vec3(0.0F), glm::vec3(1.0F));
        out.push_back({x, y, hit.point[frame.axis_n], facing >= best - best_margin, colour});
    }
}

/// Links, rings and charts over one direction's samples.
class ChartBuilder {
public:
    ChartBuilder(std::vector<ReliefSample>& samples, glm::ivec2 size, float texel_box)
        : samples_(samples), size_(size), most_step_(steepest * texel_box),
          first_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) + 1, 0),
          ring_(samples.size(), rings + 1), chart_(samples.size(), none),
          stamp_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), none) {
        for (const ReliefSample& sample : samples) {
            ++first_[cell(sample.x, sample.y) + 1];
        }
        for (std::size_t k = 1; k < first_.size(); ++k) {
            first_[k] += first_[k - 1];
        }
    }

    std::vector<std::vector<std::uint32_t>> build() {
        grow_rings();
        std::vector<std::vector<std::uint32_t>> charts;
        for (std::uint32_t s = 0; s < samples_.size(); ++s) {
            if (ring_[s] == 0 && chart_[s] == none) {
                charts.push_back(grow_chart(s, static_cast<std::uint32_t>(charts.size())));
            }
        }
        return charts;
    }

private:
    static constexpr std::array<glm::ivec2, 8> around{glm::ivec2(1, 0),  glm::ivec2(-1, 0), glm::ivec2(0, 1),
                                                      glm::ivec2(0, -1), glm::ivec2(1, 1),  glm::ivec2(-1, 1),
                                                      glm::ivec2(1, -1), glm::ivec2(-1, -1)};

    [[nodiscard]] std::size_t cell(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x);
    }

    /// The sample of the neighbouring texel that continues this one, or none.
    [[nodiscard]] std::uint32_t linked(std::uint32_t from, const glm::ivec2& step) const {
        const int x = samples_[from].x + step.x;
        const int y = samples_[from].y + step.y;
        if (x < 0 || y < 0 || x >= size_.x || y >= size_.y) {
            return none;
        }
        std::uint32_t best = none;
        float best_step = most_step_;
        for (std::uint32_t k = first_[cell(x, y)]; k < first_[cell(x, y) + 1]; ++k) {
            const float difference = std::abs(samples_[k].height - samples_[from].height);
            if (difference < best_step) {
                best_step = difference;
                best = k;
            }
        }
        return best;
    }

    void grow_rings() {
        std::vector<std::uint32_t> front;
        for (std::uint32_t s = 0; s < samples_.size(); ++s) {
            if (samples_[s].core) {
                ring_[s] = 0;
                front.push_back(s);
            }
        }
        for (std::uint8_t ring = 1; ring <= rings; ++ring) {
            std::vector<std::uint32_t> next;
            for (const std::uint32_t s : front) {
                for (const glm::ivec2& step : around) {
                    const std::uint32_t n = linked(s, step);
                    if (n != none && ring_[n] > ring) {
                        ring_[n] = ring;
                        next.push_back(n);
                    }
                }
            }
            front = std::move(next);
        }
    }

    /// Takes a texel for the chart; false if the chart has it already.
    bool claim(std::uint32_t sample, std::uint32_t chart) {
        std::uint32_t& stamp = stamp_[cell(samples_[sample].x, samples_[sample].y)];
        if (stamp == chart) {
            return false;
        }
        stamp = chart;
        return true;
    }

    std::vector<std::uint32_t> grow_chart(std::uint32_t seed, std::uint32_t id) {
        std::vector<std::uint32_t> members{seed};
        claim(seed, id);
        chart_[seed] = id;
        for (std::size_t head = 0; head < members.size(); ++head) {
            for (const glm::ivec2& step : around) {
                const std::uint32_t n = linked(members[head], step);
                if (n != none && ring_[n] <= rings && chart_[n] == none && claim(n, id)) {
                    chart_[n] = id;
                    members.push_back(n);
                }
            }
        }
        // Adds two rings of the neighbouring charts, so that seams overlap.
        std::size_t start = 0;
        for (int ring = 0; ring < 2; ++ring) {
            const std::size_t end = members.size();
            for (std::size_t head = start; head < end; ++head) {
                for (const glm::ivec2& step : around) {
                    const std::uint32_t n = linked(members[head], step);
                    if (n != none && ring_[n] <= rings && claim(n, id)) {
                        members.push_back(n);
                    }
                }
            }
            start = end;
        }
        return members;
    }

    std::vector<ReliefSample>& samples_;
    glm::ivec2 size_;
    float most_step_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint8_t> ring_;
    std::vector<std::uint32_t> chart_;
    std::vector<std::uint32_t> stamp_;
};

} // namespace

DirectionFrame frame_of(ReliefDirection direction) {
    switch (direction) {
    case ReliefDirection::PlusX:
        return {1, 2, 0, 1.0F};
    case ReliefDirection::MinusX:
        return {1, 2, 0, -1.0F};
    case ReliefDirection::PlusY:
        return {0, 2, 1, 1.0F};
    case ReliefDirection::MinusY:
        return {0, 2, 1, -1.0F};
    case ReliefDirection::PlusZ:
        return {0, 1, 2, 1.0F};
    case ReliefDirection::MinusZ:
        break;
    }
    return {0, 1, 2, -1.0F};
}

DirectionLayers make_layers(const LayerInput& input, ReliefDirection direction) {
    const DirectionFrame frame = frame_of(direction);
    const glm::ivec2 size(static_cast<int>(std::ceil(input.box_size[frame.axis_u] / input.texel_box)) + 1,
                          static_cast<int>(std::ceil(input.box_size[frame.axis_v] / input.texel_box)) + 1);
    std::vector<std::vector<ReliefSample>> rows(static_cast<std::size_t>(size.y));
    parallel_for(rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < size.x; ++x) {
                sample_ray(input, frame, x, static_cast<int>(y), rows[y]);
            }
        }
    });
    DirectionLayers layers;
    for (const std::vector<ReliefSample>& row : rows) {
        layers.samples.insert(layers.samples.end(), row.begin(), row.end());
    }
    layers.charts = ChartBuilder(layers.samples, size, input.texel_box).build();
    return layers;
}

} // namespace frustumscreen
