/// The methods that the exhibit's own is compared with, drawing the full source mesh or a simplified one.
///
/// full mesh through each visible face's collineation: one pass, exact up to texture filtering.
/// two-pass    shader lamps (Raskar, Welch, Low & Bandyopadhyay 2001): the mesh as the eye sees it into a
///             square picture cropped to the prop, then that picture projected from the eye onto the prop's
///             faces.
///
/// Samples  of the projector's picture; null: one per pixel.
/// Threads  the one whose context is current; the kiosk must outlive the technique.
#pragma once

#include "app/bench/techniques/peer_mesh.h"
#include "app/bench/techniques/sampled_peer.h"

#include <memory>
#include <string>

namespace frustumscreen::bench {

[[nodiscard]] Result<std::unique_ptr<Technique>>
make_full_mesh(const Kiosk& kiosk, std::shared_ptr<const PeerMesh> mesh,
               std::shared_ptr<const PeerSamples> samples = nullptr, const std::string& name = "full mesh");
/// `eye_pixels`: side of the eye's picture. `of_mesh` follows this number in the name.
[[nodiscard]] Result<std::unique_ptr<Technique>>
make_two_pass(const Kiosk& kiosk, std::shared_ptr<const PeerMesh> mesh, int eye_pixels,
              std::shared_ptr<const PeerSamples> samples = nullptr, const std::string& of_mesh = "");

} // namespace frustumscreen::bench
