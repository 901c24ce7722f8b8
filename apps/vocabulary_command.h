#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam vocabulary build IMAGES... --output FILE`: trains a visual vocabulary;
// `info FILE`: what it holds; `query FILE --query IMAGES...`: images looked up among others.
void AddVocabularyCommand(CLI::App& app);

}  // namespace lift_slam
