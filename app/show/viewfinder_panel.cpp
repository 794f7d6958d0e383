#include "app/show/viewfinder_panel.h"

#include "app/typography/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr double em_px = 13.0;
constexpr int line_px = 90;   ///< the longest sentence about a camera, in five rows
constexpr int margin_px = 24; ///< the corners' brackets lie outside it
constexpr glm::u8vec4 black(0, 0, 0, 255);

} // namespace

std::string viewfinder_line(const RunStatus& status) {
    if (status.camera_hz <= 0.0) {
        return std::string(status.camera.view());
    }
    return fmt::format("{}; {} \u00d7 {} pixels, {:.0f} frames a second", status.camera.view(),
                       status.camera_width, status.camera_height, status.camera_hz);
}

ViewfinderPanel::ViewfinderPanel(const geometry::Pinhole& projector)
    : area_px_(viewfinder_area_px(projector)),
      place_(glm::ivec2(projector.width, projector.height) - area_px_ - glm::ivec2(0, line_px) - margin_px),
      picture_(area_px_.x, area_px_.y + line_px, black), upload_(picture_.width, picture_.height) {}

void ViewfinderPanel::set_line(std::string line, const typography::Typesetter& typesetter) {
    if (line == line_) {
        return;
    }
    line_ = std::move(line);
    line_is_new_ = true;
    const std::array paragraphs{typography::Paragraph{
        .text = line_, .em_px = em_px, .bold = false, .brightness = 1.0, .space_before_px = 0.0}};
    typography::Canvas canvas(image::Image8(area_px_.x, line_px, black));
    canvas.coverage(typesetter.set(paragraphs, area_px_.x - 8.0), {4, 4}, typography::Colour(255));
    std::copy(canvas.image().texels.begin(), canvas.image().texels.end(),
              picture_.texels.begin() + static_cast<std::ptrdiff_t>(area_px_.x) * area_px_.y);
}

bool ViewfinderPanel::follow(Viewfinder& viewfinder) {
    const bool is_new = viewfinder.take(picture_);
    has_seen_ = has_seen_ || is_new;
    if (!is_new && !line_is_new_) {
        return false;
    }
    line_is_new_ = false;
    upload_.put(picture_);
    return true;
}

void ViewfinderPanel::forget() {
    if (has_seen_) {
        std::fill_n(picture_.texels.begin(), static_cast<std::ptrdiff_t>(area_px_.x) * area_px_.y, black);
        upload_.put(picture_);
        has_seen_ = false;
    }
}

} // namespace frustumscreen::show
