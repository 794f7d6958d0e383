#include "firmware_host/window/sdl_window.h"

#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/picture_copy.h"
#include "firmware_host/display/picture_framebuffer.h"
#include "firmware_host/window/mouse_hand.h"

#include <GLES3/gl31.h>
#include <SDL.h>
#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

constexpr double turn_of_a_notch = 0.0873; ///< 5 degrees
constexpr double turn_of_a_pixel = 0.0087; ///< half a degree

tl::unexpected<Error> no_window(const char* what) {
    return fail(ErrorKind::BadConfiguration, fmt::format("window: {}: {}", what, SDL_GetError()));
}

/// Where there is nothing else, SDL falls back to drivers that show nothing; a person may ask for one by
/// name.
bool unseen_unasked(std::string_view driver) {
    const char* const asked = std::getenv("SDL_VIDEODRIVER");
    return (driver == "offscreen" || driver == "dummy") &&
           std::string_view(asked != nullptr ? asked : "").find(driver) == std::string_view::npos;
}

/// The window with two OpenGL ES contexts, the renderer's and the copy's, and what mouse and keys did.
class SdlWindow {
public:
    explicit SdlWindow(const WindowSetUp& set_up) : set_up_(set_up), hand_(set_up.half_extent_m) {}
    ~SdlWindow();
    SdlWindow(const SdlWindow&) = delete;
    SdlWindow& operator=(const SdlWindow&) = delete;

    [[nodiscard]] Result<void> open();
    void show() const;
    void pump(MonotonicTime now);

    [[nodiscard]] const PictureFramebuffer& picture() const { return *picture_; }
    [[nodiscard]] const MouseHand& hand() const { return hand_; }
    [[nodiscard]] std::vector<PanelEvent>& presses() { return presses_; }

private:
    [[nodiscard]] PixelSize drawable() const;
    [[nodiscard]] std::optional<glm::dvec2> on_table(int x, int y) const;
    void pressed(SDL_Keycode key, MonotonicTime now);

    WindowSetUp set_up_;
    SDL_Window* window_ = nullptr;
    SDL_GLContext drawing_ = nullptr;
    SDL_GLContext copying_ = nullptr;
    std::optional<PictureFramebuffer> picture_;
    std::optional<PictureCopy> copy_;
    MouseHand hand_;
    std::vector<PanelEvent> presses_;
};

Result<void> SdlWindow::open() {
    SDL_SetHint(SDL_HINT_VIDEO_X11_FORCE_EGL, "1"); // OpenGL ES comes through EGL everywhere
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
    window_ =
        SDL_CreateWindow("FrustumScreen", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, set_up_.width,
                         set_up_.height, SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (window_ == nullptr) {
        return no_window("no window can be opened");
    }
    copying_ = SDL_GL_CreateContext(window_);
    if (copying_ == nullptr) {
        return no_window("the desktop has no OpenGL ES 3");
    }
    SDL_GL_SetSwapInterval(0); // the exhibit sets its own pace
    Result<PictureCopy> copy = PictureCopy::create();
    if (!copy) {
        return tl::unexpected<Error>(copy.error());
    }
    copy_ = std::move(*copy);
    SDL_GL_SetAttribute(SDL_GL_SHARE_WITH_CURRENT_CONTEXT, 1);
    drawing_ = SDL_GL_CreateContext(window_);
    if (drawing_ == nullptr) {
        return no_window("the desktop has no second OpenGL ES context");
    }
    Result<PictureFramebuffer> picture = PictureFramebuffer::create(set_up_.width, set_up_.height);
    if (!picture) {
        return tl::unexpected<Error>(picture.error());
    }
    picture_ = std::move(*picture);
    return {};
}

SdlWindow::~SdlWindow() {
    picture_.reset();
    if (copying_ != nullptr) {
        SDL_GL_MakeCurrent(window_, copying_);
        copy_.reset();
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

void SdlWindow::show() const {
    glFinish();
    SDL_GL_MakeCurrent(window_, copying_);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    copy_->draw(*picture_, drawable(), TopRow::Last, {0, 0, set_up_.width, set_up_.height});
    SDL_GL_SwapWindow(window_);
    SDL_GL_MakeCurrent(window_, drawing_);
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
    const PixelRectangle place = letterbox({set_up_.width, set_up_.height}, window);
    return set_up_.table_from_picture({(x + 0.5 - place.x) * set_up_.width / place.width,
                                       (y + 0.5 - place.y) * set_up_.height / place.height});
}

void SdlWindow::pressed(SDL_Keycode key, MonotonicTime now) {
    if (key == SDLK_ESCAPE) {
        std::raise(SIGTERM);
    } else if (key >= SDLK_1 && key <= SDLK_3) {
        presses_.push_back({now, static_cast<int>(key - SDLK_1), PressKind::Press});
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
            if (const auto at = on_table(event.motion.x, event.motion.y)) {
                hand_.move(*at);
            }
            if ((event.motion.state & SDL_BUTTON_RMASK) != 0) {
                hand_.turn(turn_of_a_pixel * event.motion.xrel);
            }
            break;
        case SDL_MOUSEWHEEL:
            hand_.turn(turn_of_a_notch * event.wheel.y);
            break;
        default:
            break;
        }
    }
}

class WindowDisplay final : public Display {
public:
    explicit WindowDisplay(std::shared_ptr<SdlWindow> window) : window_(std::move(window)) {}
    [[nodiscard]] int width() const override { return window_->picture().width(); }
    [[nodiscard]] int height() const override { return window_->picture().height(); }
    [[nodiscard]] unsigned framebuffer() const override { return window_->picture().name(); }
    [[nodiscard]] int buffer_age() const override { return presented_ ? 1 : 0; }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override {
        window_->show();
        presented_ = true;
        return now;
    }
    [[nodiscard]] std::string name() const override { return "window, " + gl_driver_name(); }

private:
    std::shared_ptr<SdlWindow> window_;
    bool presented_ = false;
};

class MouseTracker final : public Tracker {
public:
    explicit MouseTracker(std::shared_ptr<SdlWindow> window) : window_(std::move(window)) {}
    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override {
        window_->pump(now);
        samples.push_back(window_->hand().prop(now));
        return {};
    }
    [[nodiscard]] std::string name() const override { return "mouse"; }

private:
    std::shared_ptr<SdlWindow> window_;
};

class KeyPanel final : public Panel {
public:
    explicit KeyPanel(std::shared_ptr<SdlWindow> window) : window_(std::move(window)) {}
    [[nodiscard]] Result<void> poll(MonotonicTime /*now*/, std::vector<PanelEvent>& events) override {
        std::vector<PanelEvent>& presses = window_->presses();
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
    if (Result<void> opened = window->open(); !opened) {
        return tl::unexpected<Error>(opened.error());
    }
    return Window{std::make_unique<WindowDisplay>(window), std::make_unique<MouseTracker>(window),
                  std::make_unique<KeyPanel>(window)};
}

} // namespace frustumscreen
