/// A fake graphics card with the kernel's mode-setting behaviour: objects with properties, framebuffers,
/// flips. The test sets what its driver refuses.
///
/// Errors   negative error numbers of the kernel.
/// Source   Linux 6.1, drivers/gpu/drm:
///          drm_atomic_uapi.c    drm_mode_atomic_ioctl: unknown object or property ENOENT, unknown flag or a
///                               test with an event EINVAL; drm_property_change_valid_get (drm_property.c):
///                               immutable or out of range EINVAL; prepare_signaling: an event for each CRTC
///                               that the commit touches, EINVAL if there is none
///          drm_atomic.c         a framebuffer without a CRTC or the reverse, or a plane that cannot feed the
///                               CRTC, EINVAL; a part outside the framebuffer ENOSPC; a mode set without
///                               ALLOW_MODESET EINVAL; an event of a CRTC that is off before and afterwards
///                               EINVAL
///          drm_atomic_helper.c  an enabled CRTC without a connector or the reverse EINVAL; scaling that the
///                               driver lacks ERANGE; a non-blocking commit on a CRTC whose previous commit
///                               is not done EBUSY
///          drm_crtc.c           drm_mode_setcrtc: no connector for a mode, or no mode for a connector,
///                               EINVAL; a framebuffer that is too small ENOSPC; it returns when the mode is shown
///          drm_plane.c          drm_mode_page_flip_ioctl: nothing is shown, or a flip is pending: EBUSY
///          drm_framebuffer.c    removing a framebuffer, or closing its file, turns off its planes; without
///                               atomic commits the CRTC
///          drm_property.c       a blob lives as long as a file or a state holds it; foreign ones cannot be
///                               destroyed: EPERM
///          drm_connector.c      drm_mode_expose_to_userspace: HDMI's 3D modes are listed only for a file with
///                               DRM_CLIENT_CAP_STEREO_3D
///          drm_lease.c          a lessee's file finds only the objects of its lease, and counts its CRTCs alone; it is
///                               master while the lessor is; EBUSY for an object of another lease, EINVAL without
///                               connector, CRTC or, with universal planes, a plane, and for a lease of a lease
///          drm_vblank.c         drm_crtc_get_sequence_ioctl: EOPNOTSUPP without vertical blanks, EINVAL
///                               while the CRTC is off
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen::display {

class FakeCard;

/// An open file of a card.
struct FakeFile {
    FakeCard* card = nullptr;
    int events = -1; ///< the end of the file to which the kernel writes
    bool universal_planes = false;
    bool atomic = false;
    bool stereo = false; ///< HDMI's 3D modes are listed for it
    bool was_master = false;
    std::string renderer; ///< of a render node: the GPU's name in OpenGL; empty: the processor draws
    std::set<std::uint32_t> framebuffers, blobs, handles;
    FakeFile* lessor = nullptr;     ///< of a lease
    std::set<std::uint32_t> leased; ///< its objects
    [[nodiscard]] bool holds(std::uint32_t object) const {
        return lessor == nullptr || leased.contains(object);
    }
};

struct FakeProperty {
    std::uint32_t id = 0;
    std::string name;
    std::uint32_t flags = 0;                                    ///< DRM_MODE_PROP_...
    std::vector<std::uint64_t> limits;                          ///< of a range; for an object property, the
                                                                ///< object's type
    std::vector<std::pair<std::string, std::uint64_t>> choices; ///< of an enumeration or a bit mask
};

struct FakeConnector {
    std::uint32_t id = 0, type = 0, number = 0;
    std::vector<std::uint32_t> encoders;
    drmModeConnection cable = DRM_MODE_DISCONNECTED; ///< the actual state
    std::vector<drmModeModeInfo> edid;
    drmModeConnection known = DRM_MODE_DISCONNECTED; ///< as of the last probe
    std::vector<drmModeModeInfo> modes;
};

struct FakePlane {
    std::uint32_t id = 0, type = 0, possible_crtcs = 0;
    std::vector<std::uint32_t> formats;
};

struct FakeBuffer {
    std::uint32_t pitch = 0;
    std::shared_ptr<std::vector<std::byte>> memory;
};

struct FakeFramebuffer {
    std::uint32_t width = 0, height = 0;
    std::shared_ptr<std::vector<std::byte>> memory;
};

struct FakeChange {
    std::uint32_t object = 0, property = 0;
    std::uint64_t value = 0;
};

class FakeCard {
public:
    // Capabilities of its driver.
    bool atomic = true;
    bool universal_planes = true;
    bool vertical_blanks = true;
    bool scales = false;
    bool knows_fourcc = true; ///< false: ADDFB2 is refused
    bool monotonic = true;    ///< its events' times are monotonic
    std::uint32_t max_khz = 300'000;
    std::set<std::string> fixed; ///< properties that no commit may change
    bool has_gbm = true;
    std::string renderer; ///< its GPU's name in OpenGL; empty: no GPU, the processor draws
    // Its state.
    bool gone = false;
    bool flips_at_once = true; ///< like an emulated card; otherwise flips happen in `refresh`
    std::uint64_t time_us = 1'000'000;
    std::uint64_t refresh_us = 16'667; ///< from one refresh to the next
    std::uint32_t refreshes = 0;       ///< so far; the kernel counts them for each CRTC
    int late = 0;                      ///< refreshes that pass before queued flips take effect
    int lost = 0;                      ///< flips that will take effect without their event
    std::function<void()> refreshed;   ///< called after each refresh

    std::uint32_t add_crtc();
    std::uint32_t add_encoder(std::uint32_t possible_crtcs);
    FakeConnector& add_connector(std::uint32_t type, std::uint32_t number,
                                 std::vector<std::uint32_t> encoders);
    std::uint32_t add_plane(std::uint32_t type, std::uint32_t possible_crtcs);
    void add_property(std::uint32_t object, const FakeProperty& property, std::uint64_t value);
    void take_property(std::uint32_t object, const std::string& name);

    /// Plugs or unplugs a cable; takes effect at the next probe.
    void plug(std::uint32_t connector, std::vector<drmModeModeInfo> edid);
    void unplug(std::uint32_t connector);
    /// Another program becomes the master and drops the role again.
    void drop_master() { master_ = nullptr; }
    /// Committed states reach the screen, and their events the files.
    void refresh();

    struct Shown {
        std::uint32_t framebuffer = 0;
        drmModeModeInfo mode{};
        [[nodiscard]] bool operator==(const Shown& other) const {
            return framebuffer == other.framebuffer && mode.hdisplay == other.mode.hdisplay &&
                   mode.vdisplay == other.mode.vdisplay && mode.clock == other.mode.clock;
        }
    };
    /// The picture of a monitor at the connector; nullopt: it is dark.
    [[nodiscard]] std::optional<Shown> shown(std::uint32_t connector) const;
    /// The scanout since the last refresh.
    struct Scanned {
        std::uint32_t framebuffer = 0, first_row = 0;
        std::uint32_t waited = 0; ///< refreshes from its commit to this one; 0: it was shown before
        bool modeset = false;     ///< the commit set a mode
    };
    /// nullopt: the connector is dark.
    [[nodiscard]] std::optional<Scanned> scanned(std::uint32_t connector) const;
    /// A framebuffer's memory, row by row.
    [[nodiscard]] std::span<const std::byte> pixels(std::uint32_t framebuffer) const {
        return *framebuffers_.at(framebuffer).memory;
    }
    [[nodiscard]] bool has(std::uint32_t framebuffer) const { return framebuffers_.contains(framebuffer); }
    [[nodiscard]] std::uint32_t height(std::uint32_t framebuffer) const {
        return framebuffers_.at(framebuffer).height;
    }
    [[nodiscard]] std::uint64_t value(std::uint32_t object, const std::string& property) const;
    void set(std::uint32_t object, const std::string& property, std::uint64_t value);
    /// A property's id; 0: the object has no property of this name.
    [[nodiscard]] std::uint32_t id_of(std::uint32_t object, const std::string& property) const;
    [[nodiscard]] FakeConnector& connector(std::uint32_t id);
    /// How often a framebuffer was removed while it was shown.
    [[nodiscard]] int removed_while_shown() const { return removed_while_shown_; }

    // The kernel's calls, invoked by fake_libdrm.cpp.
    int commit(FakeFile& file, std::span<const FakeChange> changes, std::uint32_t flags,
               std::uint64_t given_back);
    int set_crtc(std::uint32_t crtc, std::uint32_t framebuffer, std::span<const std::uint32_t> connectors,
                 const drmModeModeInfo* mode);
    int page_flip(FakeFile& file, std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t flags,
                  std::uint64_t given_back);
    int set_property(std::uint32_t object, std::uint32_t property, std::uint64_t value);
    int add_framebuffer(FakeFile& file, std::uint32_t width, std::uint32_t height, std::uint32_t handle,
                        std::uint32_t pitch, std::uint32_t* id);
    int remove_framebuffer(FakeFile& file, std::uint32_t id);
    int create_blob(FakeFile& file, std::span<const std::byte> data, std::uint32_t* id);
    int destroy_blob(FakeFile& file, std::uint32_t id);
    int sequence(std::uint32_t crtc) const;
    /// Returns the new buffer's handle.
    std::uint32_t create_buffer(FakeFile& file, std::uint32_t width, std::uint32_t height);
    int destroy_buffer(FakeFile& file, std::uint32_t handle);
    [[nodiscard]] const FakeBuffer* buffer(const FakeFile& file, std::uint32_t handle) const;
    int become_master(FakeFile& file);
    [[nodiscard]] bool is_master(const FakeFile& file) const {
        return master_ == (file.lessor != nullptr ? file.lessor : &file);
    }
    /// Whether `lessor` may lease the objects; `held`: those of its other leases.
    [[nodiscard]] int judge_lease(const FakeFile& lessor, std::span<const std::uint32_t> objects,
                                  const std::set<std::uint32_t>& held) const;
    /// The objects with those that the kernel adds.
    [[nodiscard]] std::set<std::uint32_t> leased_with(const FakeFile& lessor,
                                                      std::span<const std::uint32_t> objects) const;
    /// The CRTCs of the mask as the file counts them.
    [[nodiscard]] std::uint32_t counted(const FakeFile& file, std::uint32_t crtcs) const;
    void probe(FakeConnector& connector);
    void opened(FakeFile& file);
    /// Releases the file's remaining objects and returns their description.
    [[nodiscard]] std::string closed(FakeFile& file);

    [[nodiscard]] const std::vector<std::uint32_t>& crtcs() const { return crtcs_; }
    [[nodiscard]] const std::map<std::uint32_t, std::uint32_t>& encoders() const { return encoders_; }
    [[nodiscard]] const std::vector<FakeConnector>& connectors() const { return connectors_; }
    [[nodiscard]] const std::vector<FakePlane>& planes() const { return planes_; }
    [[nodiscard]] const FakeProperty* property(std::uint32_t id) const;
    /// Properties and their values; nullptr: no such object.
    [[nodiscard]] const std::map<std::uint32_t, std::uint64_t>* values_of(std::uint32_t object) const;
    /// The CRTC that feeds an encoder; 0: none.
    [[nodiscard]] std::uint32_t crtc_of(std::uint32_t encoder) const;
    [[nodiscard]] std::uint32_t encoder_of(const FakeConnector& connector) const;

private:
    using Values = std::map<std::uint32_t, std::uint64_t>; ///< of one object, by property
    using State = std::map<std::uint32_t, Values>;         ///< by object
    struct Blob {
        std::vector<std::byte> data;
        FakeFile* owner = nullptr; ///< nullptr: only states hold it
    };
    struct Pending {
        FakeFile* file = nullptr; ///< nullptr: no file waits for the event
        std::uint64_t given_back = 0;
        std::uint32_t queued_at = 0; ///< number of the refresh before
        bool modeset = false;        ///< it may set a mode
    };
    std::uint32_t add_object(std::uint32_t kind);
    [[nodiscard]] std::uint64_t get(const State& state, std::uint32_t object, const std::string& name) const;
    void put(State& state, std::uint32_t object, const std::string& name, std::uint64_t value) const;
    [[nodiscard]] bool takes(const FakeProperty& property, std::uint64_t value) const;
    [[nodiscard]] std::optional<drmModeModeInfo> mode_of(const State& state, std::uint32_t crtc) const;
    [[nodiscard]] bool can_feed(const FakeConnector& connector, std::uint32_t crtc) const;
    [[nodiscard]] const FakePlane* primary(std::uint32_t crtc) const;
    [[nodiscard]] unsigned index_of(std::uint32_t crtc) const;
    [[nodiscard]] int judge(const State& next) const;
    [[nodiscard]] int judge_plane(const State& next, const FakePlane& plane) const;
    [[nodiscard]] int judge_crtc(const State& next, std::uint32_t crtc) const;
    [[nodiscard]] bool needs_modeset(const State& next, std::uint32_t crtc) const;
    void turn_off(State& state, std::uint32_t crtc) const;
    void settle(State next);
    /// Blocks until what is queued is on the screen.
    void finish_pending(std::uint32_t crtc);
    void forget_unheld_blobs();
    void send_event(const Pending& pending, std::uint32_t crtc) const;

    std::uint32_t last_id_ = 30;
    std::vector<std::uint32_t> crtcs_;
    std::map<std::uint32_t, std::uint32_t> encoders_; ///< with the CRTCs that can feed each
    std::vector<FakeConnector> connectors_;
    std::vector<FakePlane> planes_;
    std::map<std::uint32_t, std::uint32_t> kinds_; ///< type of each object
    std::map<std::uint32_t, FakeProperty> properties_;
    std::map<std::uint32_t, FakeFramebuffer> framebuffers_;
    std::map<std::uint32_t, Blob> blobs_;
    std::map<std::uint32_t, FakeBuffer> buffers_;
    State state_;
    std::map<std::uint32_t, Pending> pending_; ///< by CRTC
    std::map<std::uint32_t, Scanned> scanned_; ///< by CRTC
    FakeFile* master_ = nullptr;
    int removed_while_shown_ = 0;
};

} // namespace frustumscreen::display
