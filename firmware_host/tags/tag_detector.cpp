#include "firmware_host/tags/tag_detector.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

namespace frustumscreen::tags {

namespace {

constexpr int smallest_side = 16;
/// A larger number finds more tags in blur, but also more by chance.
constexpr int corrected_bits = 1;

struct DeleteFamily {
    void operator()(apriltag_family_t* family) const { tag36h11_destroy(family); }
};
struct DeleteDetector {
    void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
};
struct DeleteDetections {
    void operator()(zarray_t* detections) const { apriltag_detections_destroy(detections); }
};

FoundTag tag_of(const apriltag_detection_t& detection) {
    FoundTag tag;
    tag.id = detection.id;
    tag.margin = static_cast<double>(detection.decision_margin);
    // The library's corners begin at the bottom left of the printed tag and continue to the bottom right.
    constexpr std::array<std::size_t, 4> printed{3, 2, 1, 0};
    for (std::size_t k = 0; k < printed.size(); ++k) {
        const double(&corner)[2] = detection.p[printed[k]];
        tag.corners_px[k] = {corner[0], corner[1]};
    }
    return tag;
}

} // namespace

struct TagDetector::Library {
    std::unique_ptr<apriltag_family_t, DeleteFamily> family{tag36h11_create()};
    std::unique_ptr<apriltag_detector_t, DeleteDetector> detector{
        apriltag_detector_create()}; ///< uses the family
};

TagDetector::TagDetector(const TagDetectorOptions& options)
    : library_(std::make_unique<Library>()), options_(options) {
    apriltag_detector_add_family_bits(library_->detector.get(), library_->family.get(), corrected_bits);
    library_->detector->quad_decimate = static_cast<float>(options.decimate);
    library_->detector->qtp.min_white_black_diff = options.min_contrast;
    library_->detector->nthreads = 1;
}

TagDetector::~TagDetector() = default;

void TagDetector::find(std::span<const std::uint8_t> luma, int width, int height,
                       std::vector<FoundTag>& found) {
    found.clear();
    if (width < smallest_side || height < smallest_side ||
        luma.size() < static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        return;
    }
    // The library only reads the picture, but its type has no const.
    image_u8_t picture{width, height, width, const_cast<std::uint8_t*>(luma.data())};
    const std::unique_ptr<zarray_t, DeleteDetections> detections(
        apriltag_detector_detect(library_->detector.get(), &picture));
    for (int k = 0; k < zarray_size(detections.get()); ++k) {
        apriltag_detection_t* detection = nullptr;
        zarray_get(detections.get(), k, static_cast<void*>(&detection));
        if (static_cast<double>(detection->decision_margin) >= options_.min_margin) {
            found.push_back(tag_of(*detection));
        }
    }
}

} // namespace frustumscreen::tags
