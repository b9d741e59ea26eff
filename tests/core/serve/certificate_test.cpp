// Certificates that are made here are read back, and judged by their times, their key and their names.
#include "core/serve/certificate.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include "core/serve/readiness.h"

namespace bl::serve {
namespace {

constexpr std::int64_t kDay = 24 * 3600 * 1000;  // [ms]
constexpr long kSecondsOfDay = 24 * 3600;
constexpr std::int64_t kNow = 1'800'000'000'000;  // in 2027

// Valid from so many days after `kNow` to so many.
struct Paper {
  long begins = -10, ends = 90;
  const char* names = "DNS:session.example.org,DNS:*.rooms.example.org,IP:192.168.1.5,IP:fd00::5";
  bool is_signed_by_other = true;
};

class Certificates : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("behaviourlinks_certificates_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    authority_ = EVP_EC_gen("P-256");
    key_ = EVP_EC_gen("P-256");
  }
  void TearDown() override {
    EVP_PKEY_free(authority_);
    EVP_PKEY_free(key_);
    std::filesystem::remove_all(folder_);
  }
  template <class Content>
  void write(const char* file, const Content& content) {
    BIO* out = BIO_new_file((folder_ / file).c_str(), "w");
    content(out);
    BIO_free(out);
  }
  void write_key(const char* file, EVP_PKEY* key, const char* password = nullptr) {
    write(file, [&](BIO* out) {
      const auto* letters = reinterpret_cast<const unsigned char*>(password);
      PEM_write_bio_PrivateKey(out, key, password == nullptr ? nullptr : EVP_aes_128_cbc(), letters,
                               password == nullptr ? 0 : static_cast<int>(std::string(password).size()), nullptr, nullptr);
    });
  }
  static void name_it(X509_NAME* name, const char* text) {
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>(text), -1, -1, 0);
  }
  void make(const Paper& paper) {
    X509* certificate = X509_new();
    X509_set_version(certificate, 2);
    ASN1_TIME_set(X509_getm_notBefore(certificate), kNow / 1000 + paper.begins * kSecondsOfDay);
    ASN1_TIME_set(X509_getm_notAfter(certificate), kNow / 1000 + paper.ends * kSecondsOfDay);
    X509_set_pubkey(certificate, key_);
    name_it(X509_get_subject_name(certificate), "room");
    name_it(X509_get_issuer_name(certificate), paper.is_signed_by_other ? "authority" : "room");
    if (paper.names != nullptr) {
      X509_EXTENSION* names = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, paper.names);
      X509_add_ext(certificate, names, -1);
      X509_EXTENSION_free(names);
    }
    X509_sign(certificate, paper.is_signed_by_other ? authority_ : key_, EVP_sha256());
    write("paper.pem", [&](BIO* out) { PEM_write_bio_X509(out, certificate); });
    X509_free(certificate);
    write_key("key.pem", key_);
  }
  Result<Certificate> read(const std::vector<std::string>& hosts) {
    return read_certificate(folder_ / "paper.pem", folder_ / "key.pem", hosts);
  }
  Finding judge(const Paper& paper, const std::vector<std::string>& hosts = {"session.example.org"}) {
    make(paper);
    return judge_certificate(read(hosts), hosts, kNow);
  }

  std::filesystem::path folder_;
  EVP_PKEY *authority_ = nullptr, *key_ = nullptr;
};

TEST_F(Certificates, AreReadAsTheyWereMade) {
  make({});
  const auto found =
      read({"session.example.org", "a.rooms.example.org", "192.168.1.5", "fd00::5", "room", "192.168.1.6", "example.org"});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_EQ(found->subject, "CN=room");
  EXPECT_EQ(found->names, (std::vector<std::string>{"session.example.org", "*.rooms.example.org", "192.168.1.5", "fd00::5"}));
  EXPECT_EQ(found->fitting, (std::vector<std::string>{"session.example.org", "a.rooms.example.org", "192.168.1.5", "fd00::5"}))
      << "the subject is no name of a host";
  EXPECT_EQ(found->begins, kNow - 10 * kDay);
  EXPECT_EQ(found->ends, kNow + 90 * kDay);
  EXPECT_TRUE(found->fits_key);
  EXPECT_FALSE(found->is_of_itself);
}

// The law: only the time decides, and it decides on the whole line of days in the same order.
TEST_F(Certificates, TheVerdictFollowsTheDaysThatAreLeft) {
  for (const auto& [ends, verdict] : std::vector<std::pair<long, Verdict>>{{-1, Verdict::bad},
                                                                           {0, Verdict::bad},
                                                                           {1, Verdict::look},
                                                                           {7, Verdict::look},
                                                                           {8, Verdict::good},
                                                                           {400, Verdict::good}}) {
    const Finding finding = judge({.ends = ends});
    EXPECT_EQ(finding.verdict, verdict) << ends << ": " << finding.text;
    EXPECT_EQ(finding.subject, "encryption");
  }
  EXPECT_EQ(judge({.begins = 1}).verdict, Verdict::bad) << "not valid yet";
  EXPECT_EQ(judge({.begins = 0}).verdict, Verdict::good);
  EXPECT_NE(judge({.ends = 8}).text.find("ends on 2027-01-23 08:00 UTC"), std::string::npos) << judge({.ends = 8}).text;
  EXPECT_NE(judge({.ends = 3}).text.find("ends on 2027-01-18 08:00 UTC"), std::string::npos);
  EXPECT_NE(judge({.ends = -3}).text.find("has ended on 2027-01-12 08:00 UTC"), std::string::npos);
}

TEST_F(Certificates, TheNamesHoldWhatPeopleOpen) {
  EXPECT_EQ(judge({}, {"192.168.1.5"}).verdict, Verdict::good);
  EXPECT_EQ(judge({}, {"172.17.0.1", "192.168.1.5"}).verdict, Verdict::good) << "one of the addresses will do";
  const Finding other = judge({}, {"192.168.1.6"});
  EXPECT_EQ(other.verdict, Verdict::look);
  EXPECT_NE(other.text.find("192.168.1.6"), std::string::npos) << other.text;
  EXPECT_EQ(judge({}, {}).verdict, Verdict::look) << "behind a proxy nobody knows what people open";
  EXPECT_EQ(judge({.names = nullptr}, {"room"}).verdict, Verdict::look);
  const Finding own = judge({.is_signed_by_other = false});
  EXPECT_EQ(own.verdict, Verdict::look);
  EXPECT_NE(own.text.find("no authority"), std::string::npos) << own.text;
}

TEST_F(Certificates, AnotherKeyIsBadWhateverTheTimes) {
  make({});
  write_key("key.pem", authority_);
  const auto found = read({"session.example.org"});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->fits_key);
  const Finding finding = judge_certificate(found, {"session.example.org"}, kNow);
  EXPECT_EQ(finding.verdict, Verdict::bad);
  EXPECT_NE(finding.text.find("another key"), std::string::npos) << finding.text;
}

TEST_F(Certificates, WhatCannotBeReadIsBadAndNamed) {
  make({});
  const auto refused = [&](const char* paper, const char* key) {
    const auto found = read_certificate(folder_ / paper, folder_ / key, {});
    EXPECT_FALSE(found) << paper << ", " << key;
    EXPECT_EQ(judge_certificate(found, {}, kNow).verdict, Verdict::bad);
    return found ? "" : found.error().text();
  };
  EXPECT_NE(refused("nothing.pem", "key.pem").find("nothing.pem"), std::string::npos);
  EXPECT_NE(refused("paper.pem", "nothing.pem").find("nothing.pem"), std::string::npos);
  EXPECT_NE(refused("key.pem", "key.pem").find("no certificate"), std::string::npos);
  EXPECT_NE(refused("paper.pem", "paper.pem").find("no key"), std::string::npos);
  write_key("locked.pem", key_, "secret");
  EXPECT_NE(refused("paper.pem", "locked.pem").find("password"), std::string::npos) << "nobody is asked for it";
  std::ofstream(folder_ / "half.pem") << "-----BEGIN CERTIFICATE-----\nMIIB\n";
  EXPECT_NE(refused("half.pem", "key.pem").find("no certificate"), std::string::npos);
}

}  // namespace
}  // namespace bl::serve
