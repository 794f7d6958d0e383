/// An open graphics card: its file, its name, and its connectors.
///
/// Lease    two outputs of one card are two cards to this program: the second has a lease of its connector, with a CRTC
///          and its planes (kms_lease.h), and so its own file, its own flips and its own modes. Leased objects are left
///          alone by the first. Memory and framebuffers are on the file of the whole card for both: a driver may keep
///          one table of memory for all files of a card.
/// Threads  `look` on any one thread while the render thread sets modes; the kernel allows both.
/// Errors   BadConfiguration: no permission (a person must act, or udev is not done yet). DeviceLost: no
///          card, or one without connectors.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/display/connector_watch.h"
#include "firmware_host/display/kms_device.h"
#include "firmware_host/display/kms_mode.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::display {

/// A file that is closed with its last owner.
class OwnedFile {
public:
    explicit OwnedFile(int file) : file_(file) {}
    ~OwnedFile();
    OwnedFile(const OwnedFile&) = delete;
    OwnedFile& operator=(const OwnedFile&) = delete;
    [[nodiscard]] int get() const { return file_; }

private:
    int file_;
};

class KmsCard {
public:
    /// `name`: a path, or "card1", or empty for the first card of the best `CardRank` in `folder`. Only for a request of
    /// two halves does the kernel list HDMI's 3D modes, where the projector has them.
    [[nodiscard]] static Result<KmsCard> open(std::string_view name, const OutputRequest& request,
                                              const std::string& folder = "/dev/dri");
    /// The output of `request` as a card of its own; `stays`: name of the connector that this one keeps. A later lease
    /// replaces an earlier one, which must be closed. Waits for a probe of the connectors that is under way.
    [[nodiscard]] Result<KmsCard> lease(const OutputRequest& request, std::string_view stays);
    /// Whether a lease of this card holds this connector, CRTC or plane.
    [[nodiscard]] bool has_leased(std::uint32_t object) const {
        return std::find(leased_.begin(), leased_.end(), object) != leased_.end();
    }

    /// For modes and flips.
    [[nodiscard]] int file() const { return file_->get(); }
    /// For memory and framebuffers.
    [[nodiscard]] int memory_file() const { return whole_ ? whole_->get() : file(); }
    /// As take_screen, of the whole card.
    [[nodiscard]] bool become_master() const;
    [[nodiscard]] const std::shared_ptr<SharedCardState>& shared_state() const { return shared_state_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// False: modes are set by the kernel's legacy calls.
    [[nodiscard]] bool is_atomic() const { return atomic_; }
    /// The state of the connectors. `thoroughly` probes the projectors, which takes up to some 100 ms each;
    /// otherwise returns the kernel's knowledge.
    [[nodiscard]] CardSeen look(bool thoroughly) const;

private:
    friend class OtherCards;
    KmsCard(int file, std::string path)
        : file_(std::make_shared<OwnedFile>(file)), shared_state_(std::make_shared<SharedCardState>()),
          path_(std::move(path)) {}
    /// Switches on what the kernel offers to a file that asks for it.
    void set_capabilities(const OutputRequest& request);
    [[nodiscard]] static Result<KmsCard> open_path(const std::string& path, const OutputRequest& request);
    /// The state of a card that does not answer: it, or another one, may be back.
    [[nodiscard]] CardState state() const;

    std::shared_ptr<const OwnedFile> whole_; ///< of a lease, the whole card's; null: this is the whole card
    std::shared_ptr<const OwnedFile> file_;  ///< a lease is closed before its card
    std::shared_ptr<SharedCardState> shared_state_;
    std::vector<std::uint32_t> leased_; ///< objects that a lease of this card holds
    std::string path_;
    bool any_ = false; ///< any other card would do
    bool atomic_ = false;
};

/// Finds out whether another card has a projector, without disturbing the cards: a card is opened only after
/// a change of its connectors as listed by the kernel.
class OtherCards {
public:
    /// The other cards are in the folder of `own_path`.
    OtherCards(std::string own_path, OutputRequest request, std::string connectors = "/sys/class/drm")
        : own_path_(std::move(own_path)), connectors_(std::move(connectors)), request_(std::move(request)) {}
    [[nodiscard]] bool have_projector();

private:
    std::string own_path_;
    std::string connectors_; ///< the folder for `connected_connectors`
    OutputRequest request_;
    std::vector<std::string> looked_at_; ///< connected ones at the last look, which found no projector
};

/// The connectors of `card`. If none of them can be lit, also checks whether `others` have a projector; null:
/// the settings name this card.
[[nodiscard]] CardSeen look_for_projector(const KmsCard& card, OtherCards* others,
                                          const OutputRequest& request, bool thoroughly);

/// Uses atomic commits if the driver has them. `card` must outlive the result.
[[nodiscard]] std::unique_ptr<KmsDevice> make_kms_device(const KmsCard& card);

/// Makes this process the DRM master of an open card, which may set modes; returns true unless another
/// process is. The kernel allows it only to the first process that opened the card, and to one that was its
/// master before (drm_auth.c, drm_master_check_perm).
[[nodiscard]] bool take_screen(int card);

} // namespace frustumscreen::display
