/// The panel on the alignment pattern while the staff hold both of their buttons: the camera's picture, and below it
/// a line about the camera's state.
///
/// Place    the picture's lower right, clear of its corners and of the grid's numbers.
/// Memory   the picture is allocated at construction; `forget` and the destructor overwrite its contents, here and in
///          the GPU's memory.
/// Threads  the render thread, with the display's context current. Only `set_line` allocates.
#pragma once

#include "app/render/picture_upload.h"
#include "app/show/eye_parts.h"
#include "app/show/run_report.h"
#include "app/show/viewfinder.h"
#include "app/typography/text_image.h"

#include <string>

namespace frustumscreen::show {

/// The camera's state, its frame size and frame rate.
[[nodiscard]] std::string viewfinder_line(const RunStatus& status);

class ViewfinderPanel {
public:
    explicit ViewfinderPanel(const geometry::Pinhole& projector);
    ~ViewfinderPanel() { forget(); }
    ViewfinderPanel(const ViewfinderPanel&) = delete;
    ViewfinderPanel& operator=(const ViewfinderPanel&) = delete;

    void set_line(std::string line, const typography::Typesetter& typesetter);
    /// True if the picture has changed since the last call.
    [[nodiscard]] bool follow(Viewfinder& viewfinder);
    /// Clears the camera's picture.
    void forget();
    void show(unsigned framebuffer, const EyeParts& eyes) { eyes.show(upload_, framebuffer, place_); }

private:
    glm::ivec2 area_px_;
    glm::ivec2 place_;      ///< of its upper left corner in the projector's picture
    image::Image8 picture_; ///< the camera's picture above, the line below
    render::PictureUpload upload_;
    std::string line_;
    bool line_is_new_ = true; ///< the uploaded picture has another line, or nothing was uploaded
    bool has_seen_ = false;   ///< the picture may hold a part of a frame
};

} // namespace frustumscreen::show
