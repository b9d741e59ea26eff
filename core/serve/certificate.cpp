// OpenSSL's structures of certificates are opened and freed here only.
#include "core/serve/certificate.h"

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <ctime>
#include <memory>
#include <optional>

namespace bl::serve {

namespace {

template <auto free>
struct Free {
  template <class T>
  void operator()(T* object) const {
    free(object);
  }
};
using File = std::unique_ptr<BIO, Free<BIO_free_all>>;
using Text = std::unique_ptr<BIO, Free<BIO_free_all>>;
using Paper = std::unique_ptr<X509, Free<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using Names = std::unique_ptr<GENERAL_NAMES, Free<GENERAL_NAMES_free>>;

// OpenSSL asks at the terminal for a password, unless somebody else says that there is none.
int no_password(char*, int, int, void*) { return -1; }

std::optional<std::int64_t> moment_of(const ASN1_TIME* time) {
  constexpr std::int64_t kSecond = 1000;  // [ms]
  std::tm parts{};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return std::nullopt;
  return static_cast<std::int64_t>(::timegm(&parts)) * kSecond;
}

std::string subject_of(const X509& paper) {
  const Text text(BIO_new(BIO_s_mem()));
  X509_NAME_print_ex(text.get(), X509_get_subject_name(&paper), 0,
                     XN_FLAG_RFC2253 & ~static_cast<unsigned long>(ASN1_STRFLGS_ESC_MSB));
  char* begin = nullptr;
  const long length = BIO_get_mem_data(text.get(), &begin);
  return length > 0 ? std::string(begin, static_cast<std::size_t>(length)) : "";
}

std::string text_of(const ASN1_STRING& string) {
  // The bytes of names are letters of ASCII; the library keeps them as unsigned ones.
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(&string)), static_cast<std::size_t>(ASN1_STRING_length(&string))};
}

std::string address_of(const ASN1_OCTET_STRING& bytes) {
  char text[INET6_ADDRSTRLEN] = "";
  const int length = ASN1_STRING_length(&bytes);
  constexpr int kShort = 4, kLong = 16;
  if (length != kShort && length != kLong) return "";
  ::inet_ntop(length == kShort ? AF_INET : AF_INET6, ASN1_STRING_get0_data(&bytes), text, sizeof text);
  return text;
}

std::vector<std::string> names_of(const X509& paper) {
  std::vector<std::string> found;
  // The functions of stacks and of extensions are older than const.
  const Names names(static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(&paper, NID_subject_alt_name, nullptr, nullptr)));
  for (int k = 0; k < sk_GENERAL_NAME_num(names.get()); ++k) {
    const GENERAL_NAME* one = sk_GENERAL_NAME_value(names.get(), k);
    if (one->type == GEN_DNS) found.push_back(text_of(*one->d.dNSName));
    else if (one->type == GEN_IPADD) found.push_back(address_of(*one->d.iPAddress));
  }
  return found;
}

// As browsers do: the subject is no name of a host, and an address is none either.
bool is_for(X509& paper, const std::string& host) {
  if (X509_check_ip_asc(&paper, host.c_str(), 0) == 1) return true;
  return X509_check_host(&paper, host.c_str(), host.size(), X509_CHECK_FLAG_NEVER_CHECK_SUBJECT, nullptr) == 1;
}

}  // namespace

Result<Certificate> read_certificate(const std::string& file, const std::string& key_file,
                                     const std::vector<std::string>& hosts) {
  ERR_clear_error();
  const File in(BIO_new_file(file.c_str(), "r")), key_in(BIO_new_file(key_file.c_str(), "r"));
  if (!in) return Error{ErrorCode::io, file, "cannot be read"};
  if (!key_in) return Error{ErrorCode::io, key_file, "cannot be read"};
  const Paper paper(PEM_read_bio_X509(in.get(), nullptr, no_password, nullptr));
  if (!paper) return Error{ErrorCode::parse, file, "is no certificate in PEM form"};
  const Key key(PEM_read_bio_PrivateKey(key_in.get(), nullptr, no_password, nullptr));
  if (!key) return Error{ErrorCode::parse, key_file, "is no key in PEM form, or it needs a password"};
  const auto begins = moment_of(X509_get0_notBefore(paper.get())), ends = moment_of(X509_get0_notAfter(paper.get()));
  if (!begins || !ends) return Error{ErrorCode::parse, file, "does not say from when to when it is valid"};
  Certificate found{.subject = subject_of(*paper),
                    .names = names_of(*paper),
                    .fitting = {},
                    .begins = *begins,
                    .ends = *ends,
                    .fits_key = X509_check_private_key(paper.get(), key.get()) == 1,
                    .is_of_itself = X509_self_signed(paper.get(), 0) == 1};
  for (const std::string& host : hosts)
    if (is_for(*paper, host)) found.fitting.push_back(host);
  ERR_clear_error();  // what was no key, or no name of this host, is told above
  return found;
}

}  // namespace bl::serve
