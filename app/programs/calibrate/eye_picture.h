/// What the projector shows a person while the eyes' place in the head's sensor is measured: where the prop is to lie, the cross behind it, which of its
/// corners is to cover that, what to do.
///
/// Light    the corner is lit by a dot, and an arrow on the prop's top leads to it.
/// Units    pixels of the projector's picture.
/// Words    beside the prop, where no cross is, as large as they fit; in English, above them one sentence in the house's language, where that is
///          another one.
/// Threads  as Canvas.
#pragma once

#include "app/calibration/eye_procedure.h"
#include "app/exhibit/text_image.h"
#include "app/image/image.h"
#include "app/pack/words_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// The first line is the largest.
[[nodiscard]] std::vector<std::string> eye_words(const EyeProcedure& procedure);
/// The key of what is said now among the exhibit's own words; empty: there is none for it.
[[nodiscard]] std::string_view word_key(const EyeProcedure& procedure);
/// As large as the scene's picture. `house`: the house's words, or null.
[[nodiscard]] Image8 eye_picture(const EyeProcedure& procedure, const Typesetter& typesetter,
                                 const LanguageWords* house = nullptr);

} // namespace frustumscreen
