/// Finds AprilTags of family 36h11 in one grey picture, by libapriltag.
///
/// Frame    pixels of the picture; the centre of the top-left pixel is at (0.5, 0.5).
/// Threads  one caller: the camera's own thread. The detector and its family are made once; the library
///          allocates for each picture and starts no thread.
/// Errors   none: anything else is not found. A picture smaller than 16 x 16, or with too few pixels for its
///          size, has no tags.
/// Source   Wang and Olson, AprilTag 2: Efficient and robust fiducial detection, 2016; Debian's libapriltag
///          3.3.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::tags {

struct FoundTag {
    int id = 0;
    /// Corners of the black square, as the tag is printed: top left, top right, bottom right, bottom left.
    std::array<glm::dvec2, 4> corners_px{};
    double margin = 0.0; ///< mean distance of its bits from the threshold, in luma codes
};

struct TagDetectorOptions {
    /// Squares are searched in a picture reduced by this factor; edges and bits are read at full size. 2
    /// takes a fraction of the time, but finds no tag whose modules are smaller than about 4 pixels.
    double decimate = 1.0;
    /// Smallest luma step of an edge. The noise of a flat surface causes many smaller ones, which take more
    /// time than all tags.
    int min_contrast = 40;
    /// Smallest accepted margin of a tag; chance finds have less.
    double min_margin = 15.0;
};

class TagDetector {
public:
    explicit TagDetector(const TagDetectorOptions& options = {});
    ~TagDetector();
    TagDetector(const TagDetector&) = delete;
    TagDetector& operator=(const TagDetector&) = delete;

    /// `luma[height][width]`, row-major. Stores the tags in `found`, in any order; an id may occur twice.
    void find(std::span<const std::uint8_t> luma, int width, int height, std::vector<FoundTag>& found);

private:
    struct Library;
    std::unique_ptr<Library> library_;
    TagDetectorOptions options_;
};

} // namespace frustumscreen::tags
