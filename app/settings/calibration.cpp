#include "app/settings/calibration.h"

#include "app/settings/describe_settings.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <span>

namespace frustumscreen::settings {

namespace {

constexpr int form_version = 1;
constexpr std::array<std::string_view, 3> method_names{"corners", "touch", "auto"};

/// A measured value has no default: a missing key is refused.
template <typename Fields> void require_all(Fields& fields) {
    if constexpr (Fields::reads) {
        const std::vector<std::string> known(fields.known().begin(), fields.known().end());
        for (const std::string& key : known) {
            fields.require("calibration_file.left_out", fields.has(key), key,
                           "is left out; calibrate again, or undo this calibration");
        }
    }
}

void measured_projector(auto& fields, auto& calibration) {
    auto& pinhole = calibration.pinhole;
    fields.integer("width", pinhole.width, 64, 8192, "columns of the picture");
    fields.integer("height", pinhole.height, 64, 8192, "rows of the picture");
    fields.number("fx", pinhole.fx, focal_length, "focal length along the rows");
    fields.number("fy", pinhole.fy, focal_length, "focal length along the columns");
    constexpr Range axis{-8192.0, 16384.0, "pixels"};
    fields.number("cx", pinhole.cx, axis, "column of the optical axis");
    fields.number("cy", pinhole.cy, axis, "row of the optical axis");
    distortion_settings(fields, pinhole.lens);
    fields.rigid("table_from_projector", calibration.table_from_projector, near_the_table,
                 "16 numbers, column by column");
    require_all(fields);
}

void measured_errors(auto& fields, auto& calibration) {
    constexpr Range millimetres{0.0, 1000.0, "millimetres"};
    fields.number("mean_mm", calibration.mean_mm, millimetres, "of the places, on the table");
    fields.number("worst_mm", calibration.worst_mm, millimetres, "of the places, on the table");
    fields.number("mean_px", calibration.mean_px, {0.0, 8192.0, "pixels"}, "of the places, in the picture");
    require_all(fields);
}

void measured(auto& file, auto& calibration) {
    int version = form_version;
    file.integer("version", version, form_version, form_version, "of this file's form");
    file.text("made", calibration.made, "when, by the machine's clock");
    file.choice("method", calibration.method, method_names, "how");
    file.integer("places", calibration.places, 1, 1000, "that were measured");
    file.table("residual", "How far a place is off that was not used; after a touch-up, one that was.",
               [&](auto& fields) { measured_errors(fields, calibration); });
    file.table("projector", "As measured.", [&](auto& fields) { measured_projector(fields, calibration); });
    file.table("tracker", "As measured.", [&](auto& fields) {
        registration_settings(fields, calibration.registration);
        require_all(fields);
    });
    require_all(file);
}

/// Walks the description and writes each value under its name.
class Writer {
public:
    static constexpr bool reads = false;

    void integer(const char* key, int value, int, int, std::string_view) { line(key, value); }
    void number(const char* key, double value, const Range&, std::string_view) { line(key, value); }
    void vector(const char* key, const glm::dvec3& v, const Range&, std::string_view) {
        text_ += fmt::format("{} = [{}, {}, {}]\n", key, v.x, v.y, v.z);
    }
    void rigid(const char* key, const geometry::RigidTransform& value, const Range&, std::string_view) {
        const glm::dmat4 matrix = value.matrix();
        text_ += fmt::format("{} = [{}]\n", key, fmt::join(std::span(&matrix[0][0], 16), ", "));
    }
    void text(const char* key, const std::string& value, std::string_view) {
        text_ += fmt::format("{} = \"{}\"\n", key, value);
    }
    template <typename Choice>
    void choice(const char* key, Choice value, std::span<const std::string_view> words, std::string_view) {
        text_ += fmt::format("{} = \"{}\"\n", key, words[static_cast<std::size_t>(value)]);
    }
    void table(const char* name, std::string_view sentence, const auto& describe) {
        text_ += fmt::format("\n# {}\n[{}]\n", sentence, name);
        describe(*this);
    }

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void line(const char* key, auto value) { text_ += fmt::format("{} = {}\n", key, value); }

    std::string text_{
        "# A calibration of this kiosk, written by frustumscreen-calibrate; --undo takes it back.\n"};
};

} // namespace

std::string_view name_of(CalibrationMethod method) {
    return method_names.at(static_cast<std::size_t>(method));
}

std::string calibration_text(const Calibration& calibration) {
    Writer writer;
    measured(writer, calibration);
    return writer.text();
}

Result<Calibration> parse_calibration(std::string_view text, const std::filesystem::path& file) {
    ReadState state{.file = printable(file.string(), 4096), .folder = {}, .lines = {}, .error = std::nullopt};
    Calibration calibration;
    read_toml(state, text, largest_calibration_bytes, [&](const toml::table& root) {
        TableReader keys(state, &root, "");
        measured(keys, calibration);
        keys.finish();
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return calibration;
}

} // namespace frustumscreen::settings
