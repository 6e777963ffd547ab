// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/checksum.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <memory>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    SEAGLINT_CHECK(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1,
                   "SHA-256 is not available");
  }

  void add(const char* bytes, std::size_t count) {
    SEAGLINT_CHECK(EVP_DigestUpdate(context_.get(), bytes, count) == 1, "SHA-256 update");
  }

  std::string hexadecimal() {
    unsigned char value[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    SEAGLINT_CHECK(EVP_DigestFinal_ex(context_.get(), value, &length) == 1, "SHA-256 end");
    std::string text;
    for (unsigned int i = 0; i < length; ++i) text += fmt::format("{:02x}", value[i]);
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hexadecimal();
}

std::string sha256_file(const std::filesystem::path& file) {
  Digest digest;
  read_blocks(file, [&](std::string_view block) { digest.add(block.data(), block.size()); });
  return digest.hexadecimal();
}

}  // namespace seaglint
