// A torch: beams of a hundredth of a degree and of 179, at the surface and in it, at the end of its reach, years of scrolling, poses
// that are none.

#include "app/bench/stability/exact.h"
#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/torch/content.h"
#include "app/torch/torch.h"
#include "app/tracking/pose_frames.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

namespace frustumscreen::bench {

namespace {

using exact::Real;

constexpr double rounding = 0x1p-53;
constexpr double radians_of_deg = std::numbers::pi / 180.0;
constexpr std::array falling{torch::Attenuation::InverseSquare, torch::Attenuation::Linear,
                             torch::Attenuation::SmoothStep};

std::string name_of(torch::Attenuation attenuation) {
    return std::string(torch::attenuation_names[static_cast<std::size_t>(attenuation)]);
}

/// By the definitions in torch.h.
Real exact_attenuation(const torch::Beam& beam, Real distance) {
    const Real full = beam.full_m;
    const Real dark = beam.dark_m;
    if (distance <= full) {
        return 1;
    }
    const Real t = std::fmin(Real(1), (distance - full) / (dark - full));
    switch (beam.attenuation) {
    case torch::Attenuation::InverseSquare:
        return (full / distance) * (full / distance);
    case torch::Attenuation::Linear:
        return 1 - t;
    case torch::Attenuation::SmoothStep:
        return 1 - t * t * (3 - 2 * t);
    case torch::Attenuation::None:
        break;
    }
    return 1;
}

/// From 0.01 to 179 degrees. The tangent of half of it rounds once; a place in the content is its quotient.
StabilityResult openings(const StabilityOptions&) {
    StabilityResult result;
    std::mt19937 random(48);
    std::uniform_real_distribution<double> u(-1.2, 1.2);
    for (const double opening_deg : {0.01, 1.0, 30.0, 170.0, 179.0}) {
        torch::Beam beam;
        beam.opening_rad = opening_deg * radians_of_deg;
        beam.shape = torch::Shape::Rectangle;
        beam.attenuation = torch::Attenuation::None;
        const Real half = std::tan(Real(0.5) * Real(beam.opening_rad));
        double off = 0.0;
        double wrong = 0.0;
        double compared = 0.0;
        for (const double distance_m : sweep(1e-6, 1e3, 10)) {
            for (int k = 0; k < 50; ++k) {
                const glm::dvec3 point(u(random) * double(half) * distance_m,
                                       u(random) * double(half) * distance_m, distance_m);
                const Real x = Real(point.x) / (Real(point.z) * half);
                const Real y = Real(point.y) / (Real(point.z) * half);
                const Real edge = 1 - std::fmax(std::fabs(x), std::fabs(y));
                const std::optional<glm::dvec2> place = torch::place_in_content(beam, point);
                if (std::fabs(edge) > 8 * rounding) {
                    wrong += place.has_value() == (edge > 0) ? 0.0 : 1.0;
                }
                if (place) {
                    compared += 1.0;
                    off = std::fmax(off, double(std::fmax(std::fabs(place->x - (x + 1) / 2),
                                                          std::fabs(place->y - (y + 1) / 2))));
                }
            }
        }
        const std::string where = fmt::format("{:g} deg: ", opening_deg);
        result.rows.push_back({where + "place in the content off, of its width", 4.0 * rounding, off});
        result.rows.push_back({where + "lit and dark places mistaken", 0.0, wrong});
        result.rows.push_back(
            {where + "places compared, short of 1000", 0.0, std::fmax(0.0, 1000.0 - compared)});
    }
    return result;
}

/// On the torch's own lens, right before it, beside it, behind it.
StabilityResult at_the_lens(const StabilityOptions&) {
    double lit_wrongly = 0.0;
    double dark_wrongly = 0.0;
    double not_full = 0.0;
    for (const double opening_deg : {0.01, 30.0, 179.0}) {
        for (const torch::Shape shape : {torch::Shape::Round, torch::Shape::Rectangle}) {
            for (const torch::Attenuation attenuation : falling) {
                torch::Beam beam;
                beam.opening_rad = opening_deg * radians_of_deg;
                beam.shape = shape;
                beam.attenuation = attenuation;
                for (const double distance_m : {0.0, 1e-300, 1e-12, 1e-6, 1e-3}) {
                    not_full += torch::attenuation_at(beam, distance_m) == 1.0 ? 0.0 : 1.0;
                    const bool lit = torch::intensity_at(beam, {0.0, 0.0, distance_m}) == 1.0;
                    lit_wrongly += distance_m == 0.0 && lit ? 1.0 : 0.0;
                    dark_wrongly += distance_m > 0.0 && !lit ? 1.0 : 0.0;
                    lit_wrongly += torch::place_in_content(beam, {0.0, 0.0, -distance_m}) ? 1.0 : 0.0;
                    lit_wrongly += torch::place_in_content(beam, {distance_m, -distance_m, 0.0}) ? 1.0 : 0.0;
                }
            }
        }
    }
    return {{{"ways of 0 to 1 mm: not full", 0.0, not_full},
             {"on the axis right before the lens: dark", 0.0, dark_wrongly},
             {"at the lens, beside it, behind it: lit", 0.0, lit_wrongly}}};
}

std::array<torch::Beam, 4> beams_of(torch::Attenuation attenuation) {
    std::array<torch::Beam, 4> beams;
    constexpr std::array<std::array<double, 2>, 4> full_and_dark_m{
        {{0.3, 1.5}, {0.3, 0.3001}, {1e-6, 1e3}, {1e-3, 0.01}}};
    for (std::size_t k = 0; k < beams.size(); ++k) {
        beams[k].attenuation = attenuation;
        beams[k].full_m = full_and_dark_m[k][0];
        beams[k].dark_m = full_and_dark_m[k][1];
    }
    return beams;
}

double condition_of(const torch::Beam& beam) {
    return beam.attenuation == torch::Attenuation::InverseSquare ? 1.0
                                                                 : beam.dark_m / (beam.dark_m - beam.full_m);
}

/// A step's share rounds as its numbers do: distance / (dark - full) roundings.
StabilityResult attenuations(const StabilityOptions&) {
    StabilityResult result;
    for (const torch::Attenuation attenuation : falling) {
        double off = 0.0; // in units of the bound
        double outside = 0.0;
        double brightens = 0.0;
        for (const torch::Beam& beam : beams_of(attenuation)) {
            const double condition = condition_of(beam);
            double before = 1.0;
            for (const double distance_m : sweep(1e-9, 1e6, 200)) {
                const double now = torch::attenuation_at(beam, distance_m);
                off =
                    std::fmax(off, std::fabs(now - double(exact_attenuation(beam, distance_m))) / condition);
                outside += now >= 0.0 && now <= 1.0 ? 0.0 : 1.0;
                brightens += now <= before ? 0.0 : 1.0;
                before = now;
            }
        }
        result.rows.push_back({name_of(attenuation) + ": off, of dark / (dark - full)", 8.0 * rounding, off});
        result.rows.push_back({name_of(attenuation) + ": outside 0 to 1", 0.0, outside});
        result.rows.push_back({name_of(attenuation) + ": brightens on its way", 0.0, brightens});
    }
    return result;
}

/// Where the intensity is a hundredth: three roundings of the way times the slope there, at most 1.5 / (dark - full); of the
/// inverse square, eight of the hundredth.
StabilityResult at_its_reach(const StabilityOptions&) {
    StabilityResult result;
    for (const torch::Attenuation attenuation : falling) {
        double off = 0.0;
        double lit_beyond = 0.0;
        double dark_before = 0.0;
        for (const torch::Beam& beam : beams_of(attenuation)) {
            const double condition = condition_of(beam);
            const double reach = torch::reach_m(beam);
            off = std::fmax(off, std::fabs(double(exact_attenuation(beam, reach)) - torch::min_intensity) /
                                     condition);
            for (const double share : {4.0 * rounding, 1e-12, 1e-6, 1.0}) {
                lit_beyond += torch::place_in_content(beam, {0.0, 0.0, reach * (1.0 + share)}) ? 1.0 : 0.0;
                dark_before += torch::place_in_content(beam, {0.0, 0.0, reach / (1.0 + share)}) ? 0.0 : 1.0;
            }
        }
        result.rows.push_back(
            {name_of(attenuation) + ": intensity off 0.01, of dark / (dark - full)",
             (attenuation == torch::Attenuation::InverseSquare ? 8.0 * torch::min_intensity : 4.5) * rounding,
             off});
        result.rows.push_back({name_of(attenuation) + ": places lit beyond it", 0.0, lit_beyond});
        result.rows.push_back({name_of(attenuation) + ": places dark before it", 0.0, dark_before});
    }
    return result;
}

/// A phase of t seconds rounds by t 2^-53 of its speed, and the stage is handed on in 32 bits.
StabilityResult for_years(const StabilityOptions&) {
    StabilityResult result;
    const torch::Stage stage{.source = torch::Source::Grid,
                             .size = 0.3,
                             .scroll_per_s = {0.37, -0.21},
                             .turn_rad_per_s = 0.4,
                             .pulse_hz = 0.9,
                             .pulse_depth = 1.0};
    constexpr double height_per_width = 0.6;
    for (const double hours : {0.0, 24.0, 10.0 * 365.0 * 24.0}) {
        double off = 0.0;
        double opacity_off = 0.0;
        for (int k = 0; k < 1000; ++k) {
            const double seconds = 3600.0 * hours + 0.0137 * k;
            const torch::StageAt at = torch::stage_at(stage, height_per_width, seconds);
            const Real turn = -Real(stage.turn_rad_per_s) * Real(seconds);
            const Real height = height_per_width;
            const Real x = Real(0.25) - Real(0.5); // of the place (0.25, 0.75), from the middle
            const Real y = (Real(0.75) - Real(0.5)) * height;
            const Real size = stage.size;
            // In line distances, whole ones left out.
            const Real across = (std::cos(turn) * x - std::sin(turn) * y + Real(0.5) -
                                 Real(stage.scroll_per_s.x) * Real(seconds)) /
                                size;
            const Real down = (std::sin(turn) * x + std::cos(turn) * y +
                               (Real(0.5) - Real(stage.scroll_per_s.y) * Real(seconds)) * height) /
                              size;
            const glm::vec2 got = at.stage_from_content * glm::vec3(0.25F, 0.75F, 1.0F);
            const Real by_x = Real(got.x) / size - across;
            const Real by_y = Real(got.y) * height / size - down;
            off = std::fmax(off, double(std::fmax(std::fabs(by_x - std::round(by_x)),
                                                  std::fabs(by_y - std::round(by_y)))));
            const Real wave = std::cos(2 * std::numbers::pi_v<Real> * Real(stage.pulse_hz) * Real(seconds));
            opacity_off = std::fmax(opacity_off, double(std::fabs(Real(at.opacity) - (1 + wave) / 2)));
        }
        const double seconds = 3600.0 * hours + 14.0;
        const std::string where = fmt::format("after {:g} h: ", hours);
        result.rows.push_back({where + "a grid off, of its lines' distance",
                               8.0 * 0x1p-24 / stage.size + 8.0 * rounding * seconds / stage.size, off});
        result.rows.push_back({where + "opacity off, of 1", 0x1p-24 + 8.0 * rounding * seconds, opacity_off});
    }
    return result;
}

/// A torch whose pose is none is no torch, whatever prop and head report.
StabilityResult no_poses(const StabilityOptions&) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double taken = 0.0;
    double lost = 0.0;
    for (const glm::dquat& q :
         {glm::dquat(0.0, 0.0, 0.0, 0.0), glm::dquat(nan, 0.0, 0.0, 1.0), glm::dquat(1.0, nan, nan, nan),
          glm::dquat(infinity, 0.0, 0.0, 0.0), glm::dquat(0.0, 0.0, -infinity, 0.0)}) {
        std::vector<tracker::PoseSample> samples(2);
        samples[1].station = tracker::torch_station;
        samples[1].rotation = q;
        const std::vector<tracking::TrackedState> frames = tracking::pose_frames(samples, glm::dvec3(0.0));
        taken += frames.size() == 1 && frames[0].torches[0].share == 0.0 ? 0.0 : 1.0;
        samples[1].rotation = glm::dquat(0.0, 0.0, 1e-290, 0.0);
        const std::vector<tracking::TrackedState> short_frames =
            tracking::pose_frames(samples, glm::dvec3(0.0));
        lost += short_frames.size() == 1 && short_frames[0].torches[0].share == 1.0 ? 0.0 : 1.0;
    }
    return {{{"rotations that are none: lit", 0.0, taken}, {"a rotation of length 1e-290: dark", 0.0, lost}}};
}

} // namespace

std::vector<StabilityCase> torch_cases() {
    const std::string theme = "torch";
    return {{theme, "beams of 0.01 to 179 degrees", FloatingPoint::Strict, openings},
            {theme, "0 mm before its lens, beside and behind it", FloatingPoint::Strict, at_the_lens},
            {theme, "attenuation from 1 nm to 1000 km", FloatingPoint::Strict, attenuations},
            {theme, "attenuation at its reach", FloatingPoint::Strict, at_its_reach},
            {theme, "content after ten years", FloatingPoint::Strict, for_years},
            {theme, "poses that are none", FloatingPoint::Free, no_poses}};
}

} // namespace frustumscreen::bench
