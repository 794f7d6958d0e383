/// The alignment pattern on the display, drawn on the CPU whenever the prop has moved; or another picture for the
/// staff. With stereo each eye sees it whole, and the pattern says which eye sees what (eye_letters.h).
///
/// Threads  the render thread, with the display's context current.
/// Errors   the typeface is missing.
#pragma once

#include "app/render/picture_upload.h"
#include "app/settings/settings.h"
#include "app/show/eye_letters.h"
#include "app/show/eye_parts.h"
#include "app/show/show.h"
#include "app/show/viewfinder_panel.h"
#include "app/typography/pattern.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::show {

class PatternShow final : public Show {
public:
    static constexpr int max_buffers = 16; ///< more than any display has

    [[nodiscard]] static Result<std::unique_ptr<PatternShow>> create(const settings::Settings& settings);

    /// Updates the line about the camera, shown while the staff hold their buttons.
    void tell(const RunStatus& status) override;
    void set_viewfinder(Viewfinder* viewfinder) override { viewfinder_ = viewfinder; }
    /// Shows `picture` in place of the pattern. `with_edges`: with the prop's edges on top.
    void set_picture(image::Image8 picture, bool with_edges);
    [[nodiscard]] const typography::PatternScene& scene() const { return scene_; }
    /// Sets the lines that the pattern shows below its own text.
    void set_lines(std::vector<std::string> lines);
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                          const render::RenderTarget& target, render::Redraw redraw) override;
    /// The pattern replaces artifacts that cannot be shown.
    void is_fault() { state_ = exhibit::State::Fault; }
    [[nodiscard]] ShowState state() const override {
        ShowState state;
        state.state = state_;
        return state;
    }

private:
    PatternShow(typography::PatternScene scene, typography::Typesetter typesetter, EyeParts eyes);
    void draw_picture(const geometry::RigidTransform& table_from_prop);
    [[nodiscard]] bool follow_camera(int buffer_age);

    exhibit::State state_ = exhibit::State::Staff;
    typography::PatternScene scene_;
    typography::Typesetter typesetter_;
    EyeParts eyes_;
    render::PictureUpload upload_;
    image::Image8 table_; ///< below the prop's edges
    bool with_edges_ = true;
    std::unique_ptr<EyeLetters> letters_; ///< on the pattern; none: without stereo
    std::vector<std::string> lines_;
    std::optional<glm::dmat4> shown_;        ///< the prop's pose in the picture that was uploaded
    std::unique_ptr<ViewfinderPanel> panel_; ///< none: the settings have no camera
    Viewfinder* viewfinder_ = nullptr;
    int without_camera_ = max_buffers; ///< pictures drawn since the last one with the camera's picture
};

} // namespace frustumscreen::show
