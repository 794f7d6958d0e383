#include "app/pack/seen_errors.h"

#include "app/pack/container/limits.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <span>
#include <utility>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view levels_section = "seen_errors";
constexpr std::string_view reliefs_section = "seen_reliefs"; ///< uses the eyes of the other section
constexpr std::size_t max_eyes = 1000;

/// An eye as in the file.
struct EyeRecord {
    std::array<double, 3> towards{};
    float steepness = 1.0F;
    std::array<double, seen_patches> shares{};
    std::array<double, 3 * seen_patches> places{};
};
struct ErrorRecord {
    SeenError error;
    std::array<double, seen_patches> patches_box{};
};
struct Records {
    std::vector<EyeRecord> eyes;
    std::vector<std::vector<ErrorRecord>> levels;
};

/// A value measured with some thousand rays has no more than three significant digits; a direction needs four.
double few_digits(double value, int digits = 3) {
    return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}
float few_digits(float value) {
    return static_cast<float>(few_digits(static_cast<double>(value)));
}

EyeRecord record_of(const SeenEye& eye) {
    EyeRecord record;
    record.steepness = few_digits(eye.steepness);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<glm::length_t>(axis);
        record.towards[axis] = few_digits(eye.towards[at], 4);
        for (std::size_t k = 0; k < seen_patches; ++k) {
            record.places[3 * k + axis] = few_digits(eye.patches[k].place[at]);
        }
    }
    for (std::size_t k = 0; k < seen_patches; ++k) {
        record.shares[k] = few_digits(eye.patches[k].share);
    }
    return record;
}

SeenEye eye_of(const EyeRecord& record) {
    SeenEye eye{{record.towards[0], record.towards[1], record.towards[2]}, record.steepness, {}};
    for (std::size_t k = 0; k < seen_patches; ++k) {
        eye.patches[k] = {{record.places[3 * k], record.places[3 * k + 1], record.places[3 * k + 2]},
                          record.shares[k]};
    }
    return eye;
}

ErrorRecord record_of(const SeenError& error) {
    ErrorRecord record{{few_digits(error.mean_box),
                        few_digits(error.p95_box),
                        few_digits(error.outline_shift_box),
                        few_digits(error.silhouette_share),
                        {}},
                       {}};
    std::transform(error.patches_box.begin(), error.patches_box.end(), record.patches_box.begin(),
                   [](float box) { return few_digits(static_cast<double>(box)); });
    return record;
}

SeenError error_of(const ErrorRecord& record) {
    SeenError error = record.error;
    std::transform(record.patches_box.begin(), record.patches_box.end(), error.patches_box.begin(),
                   [](double box) { return static_cast<float>(box); });
    return error;
}

void error_records(auto& fields, const char* name, auto& surfaces, std::size_t most) {
    fields.objects(name, surfaces, most, [](auto& surface, auto& eyes) {
        surface.objects("eyes", eyes, max_eyes, [](auto& item, auto& record) {
            item.number("mean_box", record.error.mean_box);
            item.number("p95_box", record.error.p95_box);
            item.number("outline_shift_box", record.error.outline_shift_box);
            item.number("silhouette_share", record.error.silhouette_share);
            item.numbers("patches_box", std::span(record.patches_box));
        });
    });
}

void record_fields(auto& fields, auto& records) {
    fields.objects("eyes", records.eyes, max_eyes, [](auto& item, auto& eye) {
        item.numbers("towards", std::span(eye.towards));
        item.number("steepness", eye.steepness);
        item.numbers("shares", std::span(eye.shares));
        item.numbers("places", std::span(eye.places));
    });
    error_records(fields, "levels", records.levels, max_levels);
}

const PackSection* find_section(const PackDescription& pack, std::string_view name) {
    const auto found = std::find_if(pack.sections.begin(), pack.sections.end(),
                                    [name](const PackSection& section) { return section.name == name; });
    return found != pack.sections.end() ? &*found : nullptr;
}

bool is_sound(const SeenError& seen) {
    const auto allowed = [](float value, float most) {
        return value >= 0.0F && value <= most;
    };                                     // false for NaN
    constexpr float max_error_box = 10.0F; // as LevelError
    constexpr float max_share = 1e6F;
    return allowed(seen.mean_box, max_error_box) && allowed(seen.p95_box, max_error_box) &&
           allowed(seen.outline_shift_box, max_error_box) && allowed(seen.silhouette_share, max_share) &&
           std::all_of(seen.patches_box.begin(), seen.patches_box.end(),
                       [&](float box) { return allowed(box, max_error_box); });
}

bool is_sound(const std::vector<SeenError>& errors, std::size_t eyes) {
    return errors.size() == eyes &&
           std::all_of(errors.begin(), errors.end(), [](const SeenError& each) { return is_sound(each); });
}

bool is_sound(const SeenEye& eye) {
    constexpr double unit_tolerance = 1e-3;
    constexpr double farthest_box = 2.0;
    constexpr float steepest = 1e4F;
    return std::abs(glm::length(eye.towards) - 1.0) <= unit_tolerance && eye.steepness >= 1.0F &&
           eye.steepness <= steepest &&
           std::all_of(eye.patches.begin(), eye.patches.end(), [](const SeenPatch& patch) {
               return patch.share >= 0.0 && patch.share <= 1.0 && glm::length(patch.place) <= farthest_box;
           });
}

Result<void> check(const SeenErrors& seen, std::size_t levels) {
    const auto refused = [](std::string_view fault) {
        return bad_input("seen_errors.data", "sections.seen_errors.data {}", fault);
    };
    if (seen.eyes.empty() || seen.levels.size() != levels) {
        return refused(
            fmt::format("has {} levels from {} eyes; allowed are the pack's {} from one eye at least",
                        seen.levels.size(), seen.eyes.size(), levels));
    }
    if (!std::all_of(seen.eyes.begin(), seen.eyes.end(), [](const SeenEye& eye) { return is_sound(eye); })) {
        return refused("has an eye whose direction, steepness or patches are out of range");
    }
    for (const std::vector<std::vector<SeenError>>& surfaces : {seen.levels, seen.reliefs}) {
        for (const std::vector<SeenError>& each : surfaces) {
            if (!is_sound(each, seen.eyes.size())) {
                return refused(fmt::format(
                    "or seen_reliefs has a level or relief with {} errors from {} eyes; allowed are as many, "
                    "from 0 to 10",
                    each.size(), seen.eyes.size()));
            }
        }
    }
    return {};
}

std::vector<std::vector<ErrorRecord>> records_of(const std::vector<std::vector<SeenError>>& surfaces) {
    std::vector<std::vector<ErrorRecord>> records;
    for (const std::vector<SeenError>& errors : surfaces) {
        std::vector<ErrorRecord>& eyes = records.emplace_back();
        for (const SeenError& error : errors) {
            eyes.push_back(record_of(error));
        }
    }
    return records;
}

std::vector<std::vector<SeenError>> errors_of(const std::vector<std::vector<ErrorRecord>>& surfaces) {
    std::vector<std::vector<SeenError>> errors;
    for (const std::vector<ErrorRecord>& records : surfaces) {
        std::transform(records.begin(), records.end(), std::back_inserter(errors.emplace_back()), error_of);
    }
    return errors;
}

void put_section(std::string_view name, const JsonWriter& fields, PackDescription& pack) {
    assert(find_section(pack, name) == nullptr);
    pack.sections.push_back(
        {std::string(name), nlohmann::json(fields.document()).dump(), {}}); // keys in order
}

/// Calls read(fields) with the section's fields; returns false if there is no section.
template <typename Read>
Result<bool> read_section(std::string_view name, const PackDescription& pack, const Read& read) {
    const PackSection* const section = find_section(pack, name);
    if (section == nullptr) {
        return false;
    }
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, fmt::format("sections.{}.data", name));
        read(fields);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    return true;
}

} // namespace

void put_seen_errors(const SeenErrors& seen, PackDescription& pack) {
    Records records;
    for (const SeenEye& eye : seen.eyes) {
        records.eyes.push_back(record_of(eye));
    }
    records.levels = records_of(seen.levels);
    JsonWriter fields;
    record_fields(fields, std::as_const(records));
    put_section(levels_section, fields, pack);
    if (!seen.reliefs.empty()) {
        const std::vector<std::vector<ErrorRecord>> reliefs = records_of(seen.reliefs);
        JsonWriter relief_fields;
        error_records(relief_fields, "reliefs", reliefs, max_reliefs);
        put_section(reliefs_section, relief_fields, pack);
    }
}

Result<SeenErrors> seen_errors_of(const PackDescription& pack, std::size_t levels) {
    Records records;
    std::vector<std::vector<ErrorRecord>> of_reliefs;
    const Result<bool> has_levels =
        read_section(levels_section, pack, [&](JsonReader& fields) { record_fields(fields, records); });
    const Result<bool> read = has_levels.and_then([&](bool) {
        return read_section(reliefs_section, pack, [&](JsonReader& fields) {
            error_records(fields, "reliefs", of_reliefs, max_reliefs);
        });
    });
    TRY_VOID(read);
    if (!*has_levels) {
        return SeenErrors{};
    }
    SeenErrors seen{{}, errors_of(records.levels), errors_of(of_reliefs)};
    std::transform(records.eyes.begin(), records.eyes.end(), std::back_inserter(seen.eyes), eye_of);
    TRY_VOID(check(seen, levels));
    return seen;
}

} // namespace frustumscreen::pack
