#include "tests/simulators/table/simulated_board.h"

#include "firmware_host/tags/tag_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace frustumscreen::simulators {

namespace {

constexpr int rays = 2; ///< per side of a pixel that shows the tag sheet
constexpr double white = 0.85;
constexpr double black = 0.05;
constexpr double table_albedo = 0.5;
constexpr double skin = 0.35;
constexpr double along_forever = 1e9;

struct Hit {
    glm::dvec3 place;
    double albedo = 0.0;
};

/// The printed tag sheet, the prop as a solid on it, and the table.
class BoardScene {
public:
    BoardScene(const calibration::Board& board, const std::set<int>& covered,
               const glm::dmat4& table_from_prop)
        : board_(board), covered_(covered), table_from_prop_(table_from_prop),
          prop_from_table_(glm::inverse(table_from_prop)) {
        for (const tags::PropTag& tag : board.tags) {
            modules_.emplace(tag.id, tags::tag_modules_of(tag.id));
        }
    }
    [[nodiscard]] Hit seen(const glm::dvec3& from, const glm::dvec3& along) const {
        const glm::dvec3 o(prop_from_table_ * glm::dvec4(from, 1.0));
        const glm::dvec3 d(prop_from_table_ * glm::dvec4(along, 0.0));
        if (const double prop = enters_prop(o, d); prop < along_forever) {
            const glm::dvec3 at = o + prop * d;
            return {world(at), std::abs(at.z - board_.prop.height_m) < 1e-9 ? print(at) : white};
        }
        const glm::dvec3 at = o - d * (o.z / d.z);
        if (std::abs(at.x) < 0.5 * calibration::Board::size_m.x &&
            std::abs(at.y) < 0.5 * calibration::Board::size_m.y) {
            return {world(at), print(at)};
        }
        return {from - along * (from.z / along.z), table_albedo};
    }

private:
    [[nodiscard]] glm::dvec3 world(const glm::dvec3& p) const {
        return glm::dvec3(table_from_prop_ * glm::dvec4(p, 1.0));
    }
    /// The ray's first point in the solid between five planes and the tag sheet.
    [[nodiscard]] double enters_prop(const glm::dvec3& o, const glm::dvec3& d) const {
        const geometry::FrustumSize& prop = board_.prop;
        const double slope = 0.5 * (prop.base_m - prop.top_m) / prop.height_m;
        // condition: normal . p <= offset
        const std::array<std::pair<glm::dvec3, double>, 6> planes{{{{1, 0, slope}, 0.5 * prop.base_m},
                                                                   {{-1, 0, slope}, 0.5 * prop.base_m},
                                                                   {{0, 1, slope}, 0.5 * prop.base_m},
                                                                   {{0, -1, slope}, 0.5 * prop.base_m},
                                                                   {{0, 0, 1}, prop.height_m},
                                                                   {{0, 0, -1}, 0.0}}};
        double in = 0.0;
        double out = along_forever;
        for (const auto& [normal, offset] : planes) {
            const double speed = glm::dot(normal, d);
            const double left = offset - glm::dot(normal, o);
            if (speed < 0.0) {
                in = std::fmax(in, left / speed);
            } else if (speed > 0.0) {
                out = std::fmin(out, left / speed);
            } else if (left < 0.0) {
                return along_forever;
            }
        }
        return in < out ? in : along_forever;
    }
    /// Reflectance of the paper at z = 0, or of the prop's top.
    [[nodiscard]] double print(const glm::dvec3& p) const {
        for (const tags::PropTag& tag : board_.tags) {
            const glm::dvec3 off = p - tag.prop_from_tag.translation;
            const double module = tag.size_m / static_cast<double>(tags::black_modules);
            const double half = 0.5 * static_cast<double>(tags::tag_modules) * module;
            if (std::abs(off.z) < 1e-6 && std::abs(off.x) < half && std::abs(off.y) < half) {
                const auto row = static_cast<std::size_t>((half - off.y) / module);
                const auto column = static_cast<std::size_t>((half + off.x) / module);
                const bool is_white = modules_.at(tag.id)
                                          .at(std::min(row, tags::tag_modules - 1))
                                          .at(std::min(column, tags::tag_modules - 1));
                return covered_.contains(tag.id) ? skin : is_white ? white : black;
            }
        }
        return white;
    }

    const calibration::Board& board_;
    const std::set<int>& covered_;
    glm::dmat4 table_from_prop_;
    glm::dmat4 prop_from_table_;
    std::map<int, tags::TagModules> modules_;
};

/// The pixels that may show the tag sheet or the prop.
struct Window {
    glm::dvec2 low{1e9};
    glm::dvec2 high{-1e9};
};

Window window_of(const calibration::Board& board, const SimulatedCamera& camera,
                 const glm::dmat4& table_from_prop) {
    Window window;
    for (const double z : {0.0, board.prop.height_m}) {
        for (const glm::dvec2& side : std::array<glm::dvec2, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
            const double half_top = 0.5 * board.prop.top_m;
            const glm::dvec2 reach =
                z > 0.0 ? glm::dvec2(half_top)
                        : glm::max(0.5 * calibration::Board::size_m, 0.5 * board.prop.base_m);
            const glm::dvec2 at =
                camera.pixel(glm::dvec3(table_from_prop * glm::dvec4(side * reach, z, 1.0)));
            window.low = glm::min(window.low, at - 4.0);
            window.high = glm::max(window.high, at + 4.0);
        }
    }
    return window;
}

Nanoseconds nanoseconds(double seconds) {
    return Nanoseconds(std::llround(1e9 * seconds));
}

} // namespace

SimulatedBoard::SimulatedBoard(const SimulatedTable& table, const SimulatedCamera& camera,
                               calibration::Board board, const calibration::StripeSetup& stripes,
                               const BoardFaults& faults, std::uint64_t seed)
    : table_(table), camera_(camera), board_(std::move(board)), stripes_(stripes), faults_(faults),
      numbers_(seed) {
    for (int k = 0; k < 1'000'003; ++k) {
        normals_.push_back(static_cast<float>(numbers_.normal()));
    }
    show(MonotonicTime(std::chrono::hours(-1)), calibration::Pattern{calibration::Stripes::Black});
    put(table_from_prop_);
}

void SimulatedBoard::put(const glm::dmat4& table_from_prop, std::set<int> covered) {
    table_from_prop_ = table_from_prop;
    covered_ = std::move(covered);
    cast();
    for (Shown& each : shown_) {
        each.light.clear();
    }
}

void SimulatedBoard::cast() {
    const BoardScene scene(board_, covered_, table_from_prop_);
    const Window window = window_of(board_, camera_, table_from_prop_);
    const glm::dvec3 eye = camera_.eye();
    const glm::dvec3 lens = table_.truth.table_from_projector.translation;
    samples_.clear();
    for (int y = 0; y < camera_.height; ++y) {
        for (int x = 0; x < camera_.width; ++x) {
            const bool fine = x > window.low.x && x < window.high.x && y > window.low.y && y < window.high.y;
            const int side = fine ? rays : 1;
            for (int k = 0; k < side * side; ++k) {
                const glm::ivec2 cell(k % side, k / side);
                const glm::dvec2 at(x + (cell.x + 0.5) / side, y + (cell.y + 0.5) / side);
                const Hit hit = scene.seen(eye, camera_.ray(at));
                Sample sample{static_cast<std::uint32_t>(y * camera_.width + x),
                              1.0F / static_cast<float>(side * side), static_cast<float>(hit.albedo)};
                // If the projector sees something else there, the point is in shadow.
                const auto pixel = true_pixel(table_.truth, hit.place);
                if (pixel && glm::distance(scene.seen(lens, hit.place - lens).place, hit.place) < 1e-6) {
                    sample.u = static_cast<float>(pixel->x);
                    sample.v = static_cast<float>(pixel->y);
                }
                samples_.push_back(sample);
            }
        }
    }
}

void SimulatedBoard::show(MonotonicTime given_out, const calibration::Pattern& pattern) {
    shown_.push_back({given_out + nanoseconds(faults_.latency_s),
                      pattern,
                      {},
                      shown_.empty() ? Shade() : shown_.back().shade});
}

void SimulatedBoard::show(MonotonicTime given_out, const image::Image8& words) {
    std::vector<float> light;
    light.reserve(words.texels.size());
    for (const glm::u8vec4& texel : words.texels) {
        const double luma = 0.299 * texel.r + 0.587 * texel.g + 0.114 * texel.b;
        light.push_back(static_cast<float>(std::pow(luma / 255.0, faults_.light.gamma)));
    }
    shown_.push_back(
        {given_out + nanoseconds(faults_.latency_s), std::nullopt, std::move(light), shown_.back().shade});
}

void SimulatedBoard::shade(MonotonicTime from, Shade shade) {
    shown_.push_back(shown_.back());
    shown_.back().from = std::max(from, shown_.back().from);
    shown_.back().shade = std::move(shade);
    shown_.back().light.clear();
}

void SimulatedBoard::light(Shown& shown) const {
    std::optional<StripeProfile> profile;
    if (shown.pattern) {
        profile.emplace(stripes_, *shown.pattern, faults_.light);
    }
    shown.light.assign(static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height),
                       0.0);
    for (const Sample& sample : samples_) {
        double shone = 0.0;
        if (sample.u >= 0.0F && (!shown.shade || !shown.shade({sample.u, sample.v}))) {
            const auto column =
                static_cast<std::size_t>(std::min(sample.u, static_cast<float>(stripes_.width) - 1.0F));
            const auto row =
                static_cast<std::size_t>(std::min(sample.v, static_cast<float>(stripes_.height) - 1.0F));
            shone = profile ? profile->at(static_cast<double>(shown.pattern->rows ? sample.v : sample.u))
                            : static_cast<double>(
                                  shown.words[row * static_cast<std::size_t>(stripes_.width) + column]);
        }
        shown.light[sample.pixel] +=
            static_cast<double>(sample.weight * sample.albedo) * (shone + faults_.light.ambient);
    }
    blur_picture(shown.light, camera_.width, camera_.height, faults_.light.camera_blur);
}

camera::CameraFrame SimulatedBoard::frame(MonotonicTime begin) {
    while (shown_.size() > 1 && std::next(shown_.begin())->from <= begin) {
        shown_.pop_front();
    }
    camera::CameraFrame frame{begin, 0, camera_.width, camera_.height, {}};
    frame.luma.reserve(static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height));
    std::size_t noise = numbers_.below(normals_.size());
    std::vector<std::pair<const Shown*, double>> lights;
    for (int row = 0; row < camera_.height; ++row) {
        const MonotonicTime from = begin + nanoseconds(faults_.readout_s * row / camera_.height);
        const MonotonicTime to = from + nanoseconds(faults_.exposure_s);
        lights.clear();
        for (auto each = shown_.begin(); each != shown_.end(); ++each) {
            const auto next = std::next(each);
            const MonotonicTime low = std::max(from, each->from);
            const MonotonicTime high = next != shown_.end() ? std::min(to, next->from) : to;
            if (low < high) {
                if (each->light.empty()) {
                    light(*each);
                }
                lights.emplace_back(&*each, to_seconds(high - low) / faults_.exposure_s);
            }
        }
        for (int column = 0; column < camera_.width; ++column) {
            const auto pixel = static_cast<std::size_t>(row * camera_.width + column);
            double seen = 0.0;
            for (const auto& [shown, share] : lights) {
                seen += share * shown->light[pixel];
            }
            noise = noise + 1 < normals_.size() ? noise + 1 : 0;
            frame.luma.push_back(grey_of(seen, faults_.light, static_cast<double>(normals_[noise])));
        }
    }
    return frame;
}

} // namespace frustumscreen::simulators
