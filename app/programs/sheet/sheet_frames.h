/// The frames that a sheet is made of: pictures of a folder with their poses and what frames.csv says of
/// them.
///
/// Files    DIR/frame_00000.png ..., the k-th belongs to the k-th pose of station 1 in DIR/poses.csv (or
///          another pose file); DIR/frames.csv may be missing.
/// Errors   one line: file, line, what is wrong.
#pragma once

#include "app/settings/settings.h"
#include "app/simulation/visitor_view.h"
#include "app/tracking/situation.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

/// One row of frames.csv.
struct FrameRecord {
    std::int64_t t_us = 0;
    double ms = 0.0;
    std::string technique;
    std::optional<double> estimated_error_mm; ///< nothing: the frame shows nothing of an artifact
    bool drawn = true;
    std::string artifact; ///< empty if the file does not say
    std::string state;    ///< of the exhibit; the same
    std::string told;     ///< beside the short text or in its place; the same
    std::string language; ///< the same
};

struct SheetFrame {
    std::filesystem::path picture;
    Situation situation;
    std::string label;
};

struct FrameFolder {
    std::vector<SheetFrame> frames;
    std::vector<FrameRecord> records;
};

/// Columns are found by their names; those of `frustumscreen render` are enough.
[[nodiscard]] Result<std::vector<FrameRecord>> parse_frames_csv(std::string_view text,
                                                                const std::string& name);

/// `label`: for all frames; if empty the artifact of frames.csv, else the folder's name.
[[nodiscard]] Result<FrameFolder> read_frame_folder(const std::filesystem::path& folder,
                                                    const std::filesystem::path& poses,
                                                    const std::string& label,
                                                    const glm::dvec3& default_eye_m);

/// The middle frame of each of `count` equal parts; all frames if there are not more.
[[nodiscard]] std::vector<SheetFrame> evenly(const std::vector<SheetFrame>& frames, std::size_t count);

/// The frames that look different from all before: another label, place, turn or eye. The prop rests most of the time. Of those
/// that follow each other and look alike it is the middle one, where nothing fades any more.
[[nodiscard]] std::vector<SheetFrame> distinct(const std::vector<SheetFrame>& frames);

/// Errors: not a PNG; another size than the configured projector's shape.
[[nodiscard]] Result<Image8> read_picture(const SheetFrame& frame, const Pinhole& projector);

/// What stands around the visitor, for a picture of any size of the configured projector.
[[nodiscard]] VisitorScene visitor_scene(const Settings& settings, const Situation& situation,
                                         int picture_width, int picture_height);

} // namespace frustumscreen
