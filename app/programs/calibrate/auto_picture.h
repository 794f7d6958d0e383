/// What the projector shows a technician during a calibration by a camera while no stripes are shown: where the board is to stand next, and what is said.
///
/// Light    its ground is grey and not black, so that the camera sees the tags meanwhile.
/// Units    pixels of the projector's picture.
/// Words    in English; above them one sentence in the house's language, where that is another one.
/// Threads  as Canvas.
#pragma once

#include "app/calibration/auto_procedure.h"
#include "app/exhibit/text_image.h"
#include "app/image/image.h"
#include "app/pack/words_file.h"

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// The first line is the largest.
[[nodiscard]] std::vector<std::string> auto_words(const AutoProcedure& procedure);
/// The key of what is said now among the exhibit's own words; empty: there is none for it.
[[nodiscard]] std::string_view word_key(const AutoProcedure& procedure);
/// The same of a word alone: what is amiss, else how the board is to stand next. `may_go_on`: Back leads on to the crosses.
[[nodiscard]] std::string_view word_key(AutoWord word, Posture wished, bool may_go_on);
/// `board_px`: about the width of the board on the table. `house`: the house's words, or null.
[[nodiscard]] Image8 auto_picture(const AutoProcedure& procedure, int width, int height, double board_px,
                                  const Typesetter& typesetter, const LanguageWords* house = nullptr);

} // namespace frustumscreen
