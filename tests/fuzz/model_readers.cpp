// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <vector>

#include "classify/cnn/network.h"
#include "classify/features/feature_vector.h"
#include "classify/model/classifiers.h"
#include "classify/model/saved_model.h"
#include "sim/core/process/file.h"
#include "tests/fuzz/readers.h"

namespace seaglint {

void fuzz_embeddings(const std::string& bytes) {
  is_refused([&] { read_embeddings(file_of(bytes, "embeddings.csv"), std::vector<std::int64_t>{0, 1, 2}); });
}

void fuzz_trees(const std::string& bytes) {
  is_refused([&] {
    const Booster trees = Booster::load(file_of(bytes, "handmade.json"));
    FeatureMatrix row;
    for (std::size_t i = 0; i < trees.columns(); ++i) row.names.push_back("x");
    for (const float value : {-1e30f, -1.0f, 0.0f, std::nanf(""), 1.0f, 1e30f})
      row.values.insert(row.values.end(), row.names.size(), value);
    const std::size_t outputs = trees.classes() == 2 ? 1 : trees.classes();
    SEAGLINT_CHECK(trees.predict(row).size() == outputs * row.rows(), "probabilities of another number");
  });
}

void fuzz_model_card(const std::string& bytes) {
  is_refused([&] {
    const std::filesystem::path file = file_of(bytes, kModelFile);
    const ModelCard card = read_model_card(file, "0.1.0");
    learning_spec(card, file);
    SEAGLINT_CHECK(read_model_card(file_of(to_json(card), kModelFile), "0.1.0").classes == card.classes,
                   "another model after writing");
  });
}

void fuzz_network(const std::string& bytes) {
  is_refused([&] {
    const std::filesystem::path file = file_of(bytes, "network.bin");
    const Network network = Network::load(file);
    const std::vector<CentreList> maps{{}, {{-40, -0.1, 1}, {0, 0, 1}, {40, 0.1, 1}}};
    const std::size_t outputs = network.classes() == 2 ? 1 : network.classes();
    SEAGLINT_CHECK(network.embed(maps).logits.size() == outputs * maps.size(), "outputs of another number");
    network.save(file);
    SEAGLINT_CHECK(read_file(file) == bytes, "another network after writing");
  });
}

}  // namespace seaglint
