/// The frames of a sheet: pictures of a folder with their poses and their rows of frames.csv.
///
/// Files    DIR/frame_00000.png ...; the k-th belongs to the k-th pose of station 1 in DIR/poses.csv (or
///          another pose file); DIR/frames.csv may be missing.
/// Errors   one line: file, line, what is wrong.
#pragma once

#include "app/settings/settings.h"
#include "app/simulation/visitor_view.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// One row of frames.csv.
struct FrameRecord {
    std::int64_t t_us = 0;
    double ms = 0.0;
    std::string technique;
    std::optional<double> estimated_error_mm; ///< nullopt: the frame shows no artifact
    bool drawn = true;
    std::string artifact; ///< empty if the file has no such column
    std::string state;    ///< the exhibit's; empty as above
    std::string told;     ///< narration next to the short text or in its place; empty as above
    std::string language; ///< empty as above
};

struct SheetFrame {
    std::filesystem::path picture;
    tracking::TrackedState tracked_state;
    std::string label;
};

struct FrameFolder {
    std::vector<SheetFrame> frames;
    std::vector<FrameRecord> records;
};

/// Columns are identified by their names; those of `frustumscreen render` suffice.
[[nodiscard]] Result<std::vector<FrameRecord>> parse_frames_csv(std::string_view text,
                                                                const std::string& name);

/// `label`: for all frames; if empty, the artifact of frames.csv, otherwise the folder's name.
[[nodiscard]] Result<FrameFolder> read_frame_folder(const std::filesystem::path& folder,
                                                    const std::filesystem::path& poses,
                                                    const std::string& label,
                                                    const glm::dvec3& default_eye_m);

/// The middle frame of each of `count` equal parts; all frames if there are at most `count`.
[[nodiscard]] std::vector<SheetFrame> evenly(const std::vector<SheetFrame>& frames, std::size_t count);

/// The frames that differ from all earlier ones in label, place, rotation or eye, since the prop rests most
/// of the time. From successive similar frames it takes the middle one, in which no fade is in progress.
[[nodiscard]] std::vector<SheetFrame> distinct(const std::vector<SheetFrame>& frames);

/// Errors: not a PNG; an aspect ratio other than the configured projector's.
[[nodiscard]] Result<image::Image8> read_picture(const SheetFrame& frame, const geometry::Pinhole& projector);

/// The visitor's surroundings, for a picture of any size of the configured projector.
[[nodiscard]] simulation::VisitorScene visitor_scene(const settings::Settings& settings,
                                                     const tracking::TrackedState& tracked_state,
                                                     int picture_width, int picture_height);

} // namespace frustumscreen::programs
