#include "assets_baked/bake/loaders/gltf_movements.h"

#include "assets_baked/bake/loaders/gltf_curve.h"
#include "assets_baked/bake/loaders/refusal.h"
#include "assets_baked/bake/loaders/unique_names.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

namespace frustumscreen::bake {

namespace {

world::Path world_path_of(GltfPath path) {
    switch (path) {
    case GltfPath::Rotation:
        return world::Path::Rotation;
    case GltfPath::Scale:
        return world::Path::Scale;
    default:
        return world::Path::Translation;
    }
}

bool is_movement(GltfPath path) {
    return path == GltfPath::Translation || path == GltfPath::Rotation || path == GltfPath::Scale;
}

/// One for each node: true if it or a node below it is a joint of a skin.
std::vector<bool> moves_joints(const GltfModel& model, const GltfTree& tree) {
    std::vector<bool> moves(model.nodes.size(), false);
    for (const GltfSkin& skin : model.skins) {
        for (const std::size_t joint : skin.joints) {
            moves[joint] = true;
        }
    }
    for (auto node = tree.order().rbegin(); node != tree.order().rend(); ++node) {
        if (const auto parent = tree.parent_of(*node); parent && moves[*node]) {
            moves[*parent] = true;
        }
    }
    return moves;
}

/// Names of the animations of which something is lost, once each, by reason.
class LostMovements {
public:
    enum Reason { NoNode, OtherKind, Weights, Joints, NoTriangles, TooMuch };

    void add(Reason reason, const std::string& animation) {
        std::vector<std::string>& names = names_[reason];
        if (names.empty() || names.back() != animation) {
            names.push_back(animation);
        }
    }
    void tell(LoadNotes& notes) const {
        for (const auto& [reason, names] : names_) {
            const std::string list = printable(fmt::format("{}", fmt::join(names, ", ")), 200);
            switch (reason) {
            case NoNode:
                notes.lost("channels without a node that they move, which glTF ignores (of: {})", list);
                break;
            case OtherKind:
                notes.lost("channels that move something else than translation, rotation and scale (of: {})",
                           list);
                break;
            case Weights:
                notes.lost(
                    "movements of morph weights (of: {}); it stands in the shape that the file begins with",
                    list);
                break;
            case Joints:
                notes.lost(
                    "movements of a skin's joints (of: {}); only whole parts move, and the skin stands as "
                    "the file has it",
                    list);
                break;
            case NoTriangles:
                notes.lost("movements of nodes without triangles, which nobody would see (of: {})", list);
                break;
            case TooMuch:
                notes.lost(
                    "whole animations ({}): {} animations, {} channels and {} keys are allowed together, "
                    "and {} s for each",
                    list, world::max_behaviours, world::max_channels, world::max_keys, world::max_seconds);
                break;
            }
        }
    }

private:
    std::map<Reason, std::vector<std::string>> names_;
};

class Movements {
public:
    Movements(const GltfModel& model, const GltfTree& tree, GltfBuffers& buffers,
              const std::vector<GltfDraws>& draws)
        : model_(model), buffers_(buffers), moves_triangles_(moves_triangles(tree, draws)),
          moves_joints_(moves_joints(model, tree)),
          has_skin_(std::find(draws.begin(), draws.end(), GltfDraws::Skin) != draws.end()) {}

    void add(const GltfAnimation& source, std::string name) {
        const std::vector<const GltfChannel*> channels = kept_channels(source, name);
        if (channels.empty()) {
            return;
        }
        check(channels);
        std::size_t keys = 0;
        for (const GltfChannel* channel : channels) { // before any memory is allocated
            keys += model_.accessors[source.samplers[channel->sampler].input].count;
        }
        if (made_.size() >= world::max_behaviours || channels_ + channels.size() > world::max_channels ||
            keys_ + keys > world::max_keys) {
            lost_.add(LostMovements::TooMuch, name);
            return;
        }
        SourceAnimation animation{.name = std::move(name), .channels = {}};
        for (const GltfChannel* channel : channels) {
            animation.channels.push_back(
                {.cell = *channel->node,
                 .path = world_path_of(channel->path),
                 .curve = gltf_curve_of(model_, buffers_, source.samplers[channel->sampler], channel->path)});
            if (animation.channels.back().curve.times_s.back() > world::max_seconds) {
                lost_.add(LostMovements::TooMuch, animation.name);
                return;
            }
        }
        channels_ += channels.size();
        keys_ += keys;
        made_.push_back(std::move(animation));
    }

    [[nodiscard]] std::vector<SourceAnimation> take(LoadNotes& notes) {
        lost_.tell(notes);
        return std::move(made_);
    }

private:
    std::vector<const GltfChannel*> kept_channels(const GltfAnimation& source, const std::string& name) {
        std::vector<const GltfChannel*> kept;
        for (const GltfChannel& channel : source.channels) {
            if (channel.path == GltfPath::Weights) {
                lost_.add(LostMovements::Weights, name);
            } else if (!channel.node) {
                lost_.add(LostMovements::NoNode, name);
            } else if (!is_movement(channel.path)) {
                lost_.add(LostMovements::OtherKind, name);
            } else {
                const bool joints = has_skin_ && moves_joints_[*channel.node];
                const bool triangles = moves_triangles_[*channel.node];
                if (triangles) {
                    kept.push_back(&channel);
                }
                if (joints) {
                    lost_.add(LostMovements::Joints, name);
                }
                if (!joints && !triangles) {
                    lost_.add(LostMovements::NoTriangles, name);
                }
            }
        }
        return kept;
    }

    void check(const std::vector<const GltfChannel*>& channels) const {
        std::map<std::pair<std::size_t, GltfPath>, const GltfChannel*> known;
        for (const GltfChannel* channel : channels) {
            const auto [before, is_new] = known.emplace(std::pair(*channel->node, channel->path), channel);
            if (!is_new) {
                refuse_contradiction("{}: moves the same part of nodes[{}] as {}; one of them is allowed",
                                     channel->place, *channel->node, before->second->place);
            }
            if (model_.nodes[*channel->node].has_matrix) {
                refuse_contradiction("{}: moves nodes[{}], which has a matrix; glTF moves only nodes with a "
                                     "translation, rotation or scale",
                                     channel->place, *channel->node);
            }
        }
    }

    const GltfModel& model_;
    GltfBuffers& buffers_;
    std::vector<bool> moves_triangles_;
    std::vector<bool> moves_joints_;
    bool has_skin_;
    LostMovements lost_;
    std::vector<SourceAnimation> made_;
    std::size_t channels_ = 0;
    std::size_t keys_ = 0;
};

} // namespace

std::vector<SourceAnimation> gltf_movements(const GltfModel& model, const GltfTree& tree,
                                            GltfBuffers& buffers, const std::vector<GltfDraws>& draws,
                                            LoadNotes& notes) {
    Movements movements(model, tree, buffers, draws);
    UniqueNames names;
    for (std::size_t k = 0; k < model.animations.size(); ++k) {
        movements.add(model.animations[k], names.of(model.animations[k].name, "animation", k));
    }
    return movements.take(notes);
}

} // namespace frustumscreen::bake
