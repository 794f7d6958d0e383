#include "firmware_host/window/sdl_window.h"

#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/picture_copy.h"
#include "firmware_host/display/picture_framebuffer.h"
#include "firmware_host/window/mouse_hand.h"

#include <GLES3/gl31.h>
#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::window {

namespace {

constexpr double turn_of_a_notch = 0.0873; ///< 5 degrees
constexpr double turn_of_a_pixel = 0.0087; ///< half a degree
constexpr double used_share_of_desktop = 0.9;

tl::unexpected<Error> no_window(const char* what) {
    return fail(ErrorKind::BadConfiguration, "window.sdl", "window: {}: {}", what, SDL_GetError());
}

/// Whether SDL has fallen back to a driver that shows nothing, without a request for it by name.
bool unseen_unasked(std::string_view driver) {
    const char* const asked = std::getenv("SDL_VIDEODRIVER");
    return (driver == "offscreen" || driver == "dummy") &&
           std::string_view(asked != nullptr ? asked : "").find(driver) == std::string_view::npos;
}

/// The window with two OpenGL ES contexts, the renderer's and the copy's, and the input of mouse and keys.
class SdlWindow {
public:
    explicit SdlWindow(const WindowSetUp& set_up)
        : set_up_(set_up), hand_(set_up.half_extent_m, set_up.eye_m) {}
    ~SdlWindow();
    SdlWindow(const SdlWindow&) = delete;
    SdlWindow& operator=(const SdlWindow&) = delete;

    [[nodiscard]] Result<void> open();
    void show();
    void pump(MonotonicTime now);

    [[nodiscard]] const display::PictureFramebuffer& picture() const { return *picture_; }
    [[nodiscard]] bool has_shown() const { return shown_; }
    [[nodiscard]] const MouseHand& hand() const { return hand_; }
    [[nodiscard]] std::vector<panel::PanelEvent>& presses() { return presses_; }

private:
    [[nodiscard]] Result<void> create_window();
    void keep_help();
    [[nodiscard]] PixelSize drawable() const;
    [[nodiscard]] std::optional<glm::dvec2> on_table(int x, int y) const;
    void draw_help(PixelSize target) const;
    void moved(const SDL_MouseMotionEvent& motion);
    void pressed(SDL_Keycode key, MonotonicTime now);

    WindowSetUp set_up_;
    SDL_Window* window_ = nullptr;
    SDL_GLContext drawing_ = nullptr;
    SDL_GLContext copying_ = nullptr;
    std::optional<display::PictureFramebuffer> picture_;
    std::optional<display::PictureCopy> copy_;
    std::optional<SeenSurfacesPass> visitor_;
    std::optional<gl::GlTexture> help_texture_; ///< a texture of codes, and the framebuffer to copy it from
    std::optional<gl::GlFramebuffer> help_;
    SeenSurfaces seen_;
    bool helps_ = false;
    bool shown_ = false; ///< a picture has been shown
    bool stale_ = false; ///< the window's content is out of date
    MouseHand hand_;
    std::vector<panel::PanelEvent> presses_;
};

Result<void> SdlWindow::open() {
    SDL_SetHint(SDL_HINT_VIDEO_X11_FORCE_EGL, "1"); // OpenGL ES requires EGL on every desktop
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) {
        return no_window("there is no desktop here");
    }
    if (unseen_unasked(SDL_GetCurrentVideoDriver())) {
        SDL_SetError("SDL has only its driver '%s', which shows nothing", SDL_GetCurrentVideoDriver());
        return no_window("there is no desktop here");
    }
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
    TRY_VOID(create_window());
    copying_ = SDL_GL_CreateContext(window_);
    if (copying_ == nullptr) {
        return no_window("the desktop has no OpenGL ES 3");
    }
    SDL_GL_SetSwapInterval(0); // the exhibit sets its own pace
    TRY(copy_, display::PictureCopy::create());
    TRY(visitor_, SeenSurfacesPass::create());
    keep_help();
    SDL_GL_SetAttribute(SDL_GL_SHARE_WITH_CURRENT_CONTEXT, 1);
    drawing_ = SDL_GL_CreateContext(window_);
    if (drawing_ == nullptr) {
        return no_window("the desktop has no second OpenGL ES context");
    }
    TRY(picture_, display::PictureFramebuffer::create(set_up_.width, set_up_.height));
    return {};
}

/// Both halves next to each other, as large as the picture if the desktop has the space.
Result<void> SdlWindow::create_window() {
    SDL_Rect desktop{0, 0, 2 * set_up_.width, set_up_.height};
    double scale = 1.0;
    if (SDL_GetDisplayUsableBounds(0, &desktop) == 0) {
        scale = std::min({1.0, used_share_of_desktop * desktop.w / (2.0 * set_up_.width),
                          used_share_of_desktop * desktop.h / set_up_.height});
    }
    window_ = SDL_CreateWindow("FrustumScreen - H: help", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                               static_cast<int>(2.0 * scale * set_up_.width),
                               static_cast<int>(scale * set_up_.height),
                               SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    return window_ != nullptr ? Result<void>{} : no_window("no window can be opened");
}

SdlWindow::~SdlWindow() {
    picture_.reset();
    if (copying_ != nullptr) {
        SDL_GL_MakeCurrent(window_, copying_);
        copy_.reset();
        visitor_.reset();
        help_.reset();
        help_texture_.reset();
        SDL_GL_DeleteContext(copying_);
    }
    if (drawing_ != nullptr) {
        SDL_GL_DeleteContext(drawing_);
    }
    if (window_ != nullptr) {
        SDL_DestroyWindow(window_);
    }
    SDL_Quit();
}

void SdlWindow::show() {
    glFinish();
    SDL_GL_MakeCurrent(window_, copying_);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    const PixelSize target = drawable();
    const PixelSize half{std::max(target.width / 2, 1), target.height};
    copy_->draw(*picture_, half, display::TopRow::Last,
                {.x = 0, .y = 0, .width = set_up_.width, .height = set_up_.height});
    if (set_up_.see) {
        seen_.triangles.clear();
        seen_.lines.clear();
        set_up_.see(hand_.prop({}), hand_.head({}).position_m, half, seen_);
        visitor_->draw(*picture_, seen_,
                       {.x = half.width, .y = 0, .width = half.width, .height = half.height});
    }
    if (helps_ && help_) {
        draw_help(target);
    }
    SDL_GL_SwapWindow(window_);
    SDL_GL_MakeCurrent(window_, drawing_);
    stale_ = false;
    shown_ = true;
}

void SdlWindow::keep_help() {
    if (set_up_.help.rgba.empty()) {
        return;
    }
    help_texture_ = gl::GlTexture::generate();
    help_ = gl::GlFramebuffer::generate();
    glBindTexture(GL_TEXTURE_2D, help_texture_->get());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, set_up_.help.size.width, set_up_.help.size.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, set_up_.help.rgba.data());
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, help_->get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, help_texture_->get(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/// Draws the help in the window's middle; the window's rows count from the bottom.
void SdlWindow::draw_help(PixelSize target) const {
    const PixelSize& size = set_up_.help.size;
    const int x = (target.width - size.width) / 2;
    const int y = (target.height - size.height) / 2;
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, help_->get());
    glBlitFramebuffer(0, 0, size.width, size.height, x, y + size.height, x + size.width, y,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

PixelSize SdlWindow::drawable() const {
    PixelSize size;
    SDL_GL_GetDrawableSize(window_, &size.width, &size.height);
    return {std::max(size.width, 1), std::max(size.height, 1)};
}

/// The mouse's position is in the window's own units, which need not be pixels.
std::optional<glm::dvec2> SdlWindow::on_table(int x, int y) const {
    PixelSize window;
    SDL_GetWindowSize(window_, &window.width, &window.height);
    window = {std::max(window.width, 1), std::max(window.height, 1)};
    const PixelSize half{std::max(window.width / 2, 1), window.height};
    if (x >= half.width && set_up_.table_from_view) {
        return set_up_.table_from_view({x - half.width + 0.5, y + 0.5}, hand_.head({}).position_m, half);
    }
    const PixelRectangle place = display::letterbox({set_up_.width, set_up_.height}, half);
    return set_up_.table_from_picture({(x + 0.5 - place.x) * set_up_.width / place.width,
                                       (y + 0.5 - place.y) * set_up_.height / place.height});
}

void SdlWindow::moved(const SDL_MouseMotionEvent& motion) {
    if (const auto at = on_table(motion.x, motion.y)) {
        hand_.move(*at);
    }
    if ((motion.state & SDL_BUTTON_RMASK) != 0) {
        hand_.turn(turn_of_a_pixel * motion.xrel);
    }
    if ((motion.state & SDL_BUTTON_MMASK) != 0) { // as if the table were turned and tilted
        hand_.look(-turn_of_a_pixel * motion.xrel, turn_of_a_pixel * motion.yrel);
    }
    stale_ = stale_ || motion.state != 0;
}

void SdlWindow::pressed(SDL_Keycode key, MonotonicTime now) {
    if (key == SDLK_ESCAPE) {
        std::raise(SIGTERM);
    } else if (key >= SDLK_1 && key <= SDLK_7) {
        presses_.push_back({now, static_cast<int>(key - SDLK_1), panel::PressKind::Press});
    } else if (key == SDLK_h) {
        helps_ = !helps_;
        stale_ = true;
    }
}

void SdlWindow::pump(MonotonicTime now) {
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) {
        switch (event.type) {
        case SDL_QUIT:
            std::raise(SIGTERM);
            break;
        case SDL_KEYDOWN:
            if (event.key.repeat == 0) {
                pressed(event.key.keysym.sym, now);
            }
            break;
        case SDL_MOUSEBUTTONDOWN:
            if (const auto at = on_table(event.button.x, event.button.y);
                at && event.button.button == SDL_BUTTON_LEFT) {
                hand_.take(*at);
            }
            break;
        case SDL_MOUSEBUTTONUP:
            if (event.button.button == SDL_BUTTON_LEFT) {
                hand_.let_go();
            }
            break;
        case SDL_MOUSEMOTION:
            moved(event.motion);
            break;
        case SDL_MOUSEWHEEL:
            hand_.turn(turn_of_a_notch * event.wheel.y);
            stale_ = true;
            break;
        case SDL_WINDOWEVENT:
            stale_ = true;
            break;
        default:
            break;
        }
    }
    if (stale_ && shown_) {
        show(); // the exhibit presents only new pictures
    }
}

class WindowDisplay final : public display::Display {
public:
    explicit WindowDisplay(std::shared_ptr<SdlWindow> window) : window_(std::move(window)) {}
    [[nodiscard]] int width() const override { return window_->picture().width(); }
    [[nodiscard]] int height() const override { return window_->picture().height(); }
    [[nodiscard]] unsigned framebuffer() const override { return window_->picture().name(); }
    [[nodiscard]] int buffer_age() const override { return window_->has_shown() ? 1 : 0; }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override {
        window_->show();
        return now;
    }
    [[nodiscard]] std::string name() const override { return "window, " + display::gl_driver_name(); }

private:
    std::shared_ptr<SdlWindow> window_;
};

class MouseTracker final : public tracker::Tracker {
public:
    explicit MouseTracker(std::shared_ptr<SdlWindow> window) : window_(std::move(window)) {}
    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<tracker::PoseSample>& samples) override {
        window_->pump(now);
        samples.push_back(window_->hand().prop(now));
        samples.push_back(window_->hand().head(now));
        return {};
    }
    [[nodiscard]] std::string name() const override { return "mouse"; }

private:
    std::shared_ptr<SdlWindow> window_;
};

class KeyPanel final : public panel::Panel {
public:
    explicit KeyPanel(std::shared_ptr<SdlWindow> window) : window_(std::move(window)) {}
    [[nodiscard]] Result<void> poll(MonotonicTime /*now*/, std::vector<panel::PanelEvent>& events) override {
        std::vector<panel::PanelEvent>& presses = window_->presses();
        events.insert(events.end(), presses.begin(), presses.end());
        presses.clear();
        return {};
    }
    [[nodiscard]] std::string name() const override { return "keys of the window"; }

private:
    std::shared_ptr<SdlWindow> window_;
};

} // namespace

Result<Window> open_window(const WindowSetUp& set_up) {
    const auto window = std::make_shared<SdlWindow>(set_up);
    TRY_VOID(window->open());
    return Window{std::make_unique<WindowDisplay>(window), std::make_unique<MouseTracker>(window),
                  std::make_unique<KeyPanel>(window)};
}

} // namespace frustumscreen::window
