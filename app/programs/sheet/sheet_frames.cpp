#include "app/programs/sheet/sheet_frames.h"

#include "app/geometry/rotation_angle.h"
#include "app/tracking/pose_frames.h"
#include "firmware_host/base/file.h"
#include "firmware_host/tracker/pose_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>

namespace frustumscreen::programs {

namespace {

/// Fields of one line; quotes as in RFC 4180, but without line breaks inside.
std::vector<std::string> csv_fields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (line[k] == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"') {
            fields.back() += line[++k];
        } else if (line[k] == '"') {
            quoted = !quoted;
        } else if (line[k] == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += line[k];
        }
    }
    return fields;
}

class Columns {
public:
    explicit Columns(const std::vector<std::string>& header) {
        for (std::size_t k = 0; k < header.size(); ++k) {
            index_.emplace(header[k], k);
        }
    }
    [[nodiscard]] bool has(const std::string& name) const { return index_.contains(name); }
    [[nodiscard]] std::string of(const std::vector<std::string>& fields, const std::string& name) const {
        const auto found = index_.find(name);
        return found != index_.end() && found->second < fields.size() ? fields[found->second] : std::string();
    }

private:
    std::map<std::string, std::size_t> index_;
};

std::optional<double> number(const std::string& text) {
    double value = 0.0;
    const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

std::string label_of(const std::vector<FrameRecord>& records, std::int64_t t_us,
                     const std::string& otherwise) {
    const auto found = std::find_if(records.begin(), records.end(),
                                    [&](const FrameRecord& record) { return record.t_us == t_us; });
    if (found == records.end() || found->artifact.empty()) {
        return otherwise;
    }
    std::string label = found->artifact;
    std::string_view before = ": ";
    for (const std::string& part : {found->state, found->told, found->language}) {
        if (!part.empty()) {
            label.append(before).append(part);
            before = ", ";
        }
    }
    return label;
}

bool looks_like(const SheetFrame& a, const SheetFrame& b) {
    constexpr double near_m = 0.02;
    constexpr double near_eye_m = 0.05;
    constexpr double near_deg = 8.0;
    const geometry::RigidTransform& pose_a = a.tracked_state.table_from_prop;
    const geometry::RigidTransform& pose_b = b.tracked_state.table_from_prop;
    return a.label == b.label && glm::distance(pose_a.translation, pose_b.translation) < near_m &&
           glm::distance(a.tracked_state.eye_m, b.tracked_state.eye_m) < near_eye_m &&
           glm::degrees(geometry::rotation_angle(pose_a.rotation, pose_b.rotation)) < near_deg;
}

Result<void> check_folder(const std::filesystem::path& folder, const std::filesystem::path& pose_file) {
    if (!std::filesystem::is_directory(folder)) {
        return bad_input("sheet.no_folder", folder.string() + ": there is no such folder");
    }
    if (const auto cameras = folder / simulation::visitor_cameras_name; std::filesystem::exists(cameras)) {
        return bad_input("sheet.visitors_pictures",
                         "{}: these pictures show what the visitor sees; a sheet needs the projector's "
                         "pictures, from render without --view visitor",
                         cameras.string());
    }
    if (!std::filesystem::exists(pose_file)) {
        return bad_input("sheet.no_pose_file",
                         pose_file.string() + ": there is no such file; name it with --poses");
    }
    return {};
}

} // namespace

Result<std::vector<FrameRecord>> parse_frames_csv(std::string_view text, const std::string& name) {
    std::vector<FrameRecord> records;
    std::optional<Columns> columns;
    int line_number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line_number;
        if (!line.empty() && line.back() == '\r') {
            line.remove_suffix(1);
        }
        if (line.empty() || line.front() == '#') {
            continue;
        }
        const std::vector<std::string> fields = csv_fields(line);
        if (!columns) {
            columns.emplace(fields);
            if (!columns->has("t_us") || !columns->has("ms")) {
                return bad_input(
                    "sheet.no_time_columns",
                    "{}:{}: the header lacks t_us or ms; take frames.csv as run or render wrote it", name,
                    line_number);
            }
            continue;
        }
        const std::optional<double> t_us = number(columns->of(fields, "t_us"));
        const std::optional<double> ms = number(columns->of(fields, "ms"));
        if (!t_us || !ms || std::abs(*t_us) > 1e15) {
            return bad_input("sheet.times",
                             "{}:{}: t_us and ms must be numbers; take frames.csv as run or render wrote it",
                             name, line_number);
        }
        records.push_back({.t_us = static_cast<std::int64_t>(*t_us),
                           .ms = *ms,
                           .technique = columns->of(fields, "technique"),
                           .estimated_error_mm = number(columns->of(fields, "estimated_error_mm")),
                           .drawn = columns->of(fields, "drawn") != "0",
                           .artifact = columns->of(fields, "artifact"),
                           .state = columns->of(fields, "state"),
                           .told = columns->of(fields, "told"),
                           .language = columns->of(fields, "language")});
    }
    return records;
}

Result<FrameFolder> read_frame_folder(const std::filesystem::path& folder, const std::filesystem::path& poses,
                                      const std::string& label, const glm::dvec3& default_eye_m) {
    const std::filesystem::path pose_file = poses.empty() ? folder / "poses.csv" : poses;
    TRY_VOID(check_folder(folder, pose_file));
    TRY(const Bytes bytes, read_file(pose_file));
    TRY(const std::vector<tracker::PoseSample> samples,
        tracker::parse_poses(as_text(bytes), pose_file.string()));
    FrameFolder result;
    const std::filesystem::path list = folder / "frames.csv";
    if (std::filesystem::exists(list)) {
        TRY(const Bytes text, read_file(list));
        TRY(result.records, parse_frames_csv(as_text(text), list.string()));
    }
    const std::string folder_name = std::filesystem::absolute(folder / "x").parent_path().filename().string();
    for (FrameRecord& record : result.records) {
        record.artifact = !label.empty() ? label : record.artifact.empty() ? folder_name : record.artifact;
    }
    for (const tracking::TrackedState& tracked_state : tracking::pose_frames(samples, default_eye_m)) {
        const std::filesystem::path file = folder / fmt::format("frame_{:05}.png", result.frames.size());
        if (!std::filesystem::exists(file)) {
            break;
        }
        const std::string otherwise = label.empty() ? folder_name : label;
        result.frames.push_back(
            {file, tracked_state, label_of(result.records, to_microseconds(tracked_state.time), otherwise)});
    }
    if (result.frames.empty()) {
        return bad_input("sheet.no_frames", folder.string() +
                                                ": there is no frame_00000.png with a pose in " +
                                                pose_file.string());
    }
    return result;
}

std::vector<SheetFrame> evenly(const std::vector<SheetFrame>& frames, std::size_t count) {
    if (frames.size() <= count || count == 0) {
        return frames;
    }
    std::vector<SheetFrame> chosen;
    for (std::size_t k = 0; k < count; ++k) {
        // The middle of each of `count` equal parts.
        chosen.push_back(frames[(2 * k + 1) * frames.size() / (2 * count)]);
    }
    return chosen;
}

std::vector<SheetFrame> distinct(const std::vector<SheetFrame>& frames) {
    std::vector<SheetFrame> kept;
    for (auto first = frames.begin(); first != frames.end();) {
        const auto end = std::find_if_not(first, frames.end(),
                                          [&](const SheetFrame& one) { return looks_like(*first, one); });
        const SheetFrame& middle = *(first + (end - first) / 2);
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const SheetFrame& one) { return looks_like(middle, one); })) {
            kept.push_back(middle);
        }
        first = end;
    }
    return kept;
}

Result<image::Image8> read_picture(const SheetFrame& frame, const geometry::Pinhole& projector) {
    TRY(const Bytes bytes, read_file(frame.picture));
    TRY(image::Image8 picture, at(frame.picture.string(), image::decode_png8(bytes)));
    if (std::abs(picture.width * projector.height - picture.height * projector.width) >
        std::max(projector.width, projector.height)) {
        return bad_input("sheet.frame_shape",
                         "{}: {} x {} pixels do not have the shape of the configured projector's {} x {}; "
                         "name the settings with which they were drawn",
                         frame.picture.string(), picture.width, picture.height, projector.width,
                         projector.height);
    }
    return picture;
}

simulation::VisitorScene visitor_scene(const settings::Settings& settings,
                                       const tracking::TrackedState& tracked_state, int picture_width,
                                       int picture_height) {
    return {.projector = settings.projector.pinhole.scaled_to(picture_width, picture_height),
            .table_from_projector = settings.projector.table_from_projector,
            .prop = settings::make_prop(settings.prop),
            .table_from_prop = tracked_state.table_from_prop,
            .eye_m = tracked_state.eye_m,
            .table_size_m = {settings.table.width_m, settings.table.depth_m}};
}

} // namespace frustumscreen::programs
