/// What lies on the alignment pattern while the staff hold both of their buttons: what the camera sees, and below it a line that says
/// how the camera is.
///
/// Place    the picture's lower right, where neither its corners nor the grid's figures are.
/// Memory   the picture is taken at the construction; what it showed is overwritten by `forget` and by the end, here and in the GPU's.
/// Threads  the render thread, with the display's context current. Only `set_line` allocates.
#pragma once

#include "app/render/picture_upload.h"
#include "app/show/run_report.h"
#include "app/show/viewfinder.h"
#include "app/typography/text_image.h"

#include <string>

namespace frustumscreen {

/// How the camera is, the size of its frames, and how many come in a second.
[[nodiscard]] std::string viewfinder_line(const RunStatus& status);

class ViewfinderPanel {
public:
    explicit ViewfinderPanel(const Pinhole& projector);
    ~ViewfinderPanel() { forget(); }
    ViewfinderPanel(const ViewfinderPanel&) = delete;
    ViewfinderPanel& operator=(const ViewfinderPanel&) = delete;

    void set_line(std::string line, const Typesetter& typesetter);
    /// True: what it shows has changed since the last call.
    [[nodiscard]] bool follow(Viewfinder& viewfinder);
    /// From now on it shows nothing of a camera.
    void forget();
    void show(unsigned framebuffer) { upload_.show_again(framebuffer, place_); }

private:
    glm::ivec2 room_;
    glm::ivec2 place_; ///< of its upper left corner in the projector's picture
    Image8 picture_;   ///< the camera's above, the line below
    PictureUpload upload_;
    std::string line_;
    bool line_is_new_ = true; ///< what was uploaded has another, or nothing was
    bool has_seen_ = false;   ///< the picture may hold a part of a frame
};

} // namespace frustumscreen
