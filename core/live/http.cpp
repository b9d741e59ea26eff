// Asks an HTTP server for a page again and again, and reads the number in it.
#include <curl/curl.h>

#include <chrono>
#include <memory>
#include <string>

#include "core/live/endpoint.h"
#include "core/live/message.h"

namespace bl::live {

namespace {

constexpr int kHttpSlice = 50;       // [ms] between two looks at whether the end is asked for
constexpr long kConnectTime = 5000;  // [ms]
constexpr long kWholeTime = 15000;   // [ms]
constexpr long kRedirections = 3;

struct HttpLibrary {
  HttpLibrary() { curl_global_init(CURL_GLOBAL_DEFAULT); }
  ~HttpLibrary() { curl_global_cleanup(); }
};

struct Page {
  std::string text;
  bool is_too_long = false;
  static std::size_t take(char* bytes, std::size_t size, std::size_t count, void* self) {
    Page& page = *static_cast<Page*>(self);
    page.is_too_long = page.is_too_long || page.text.size() + size * count > kLongestPayload;
    if (page.is_too_long) return 0;
    page.text.append(bytes, size * count);
    return size * count;
  }
};

class Client {
 public:
  explicit Client(const std::string& url)
      : easy_(curl_easy_init(), curl_easy_cleanup), multi_(curl_multi_init(), curl_multi_cleanup) {
    curl_easy_setopt(easy_.get(), CURLOPT_URL, url.c_str());
    curl_easy_setopt(easy_.get(), CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(easy_.get(), CURLOPT_REDIR_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(easy_.get(), CURLOPT_FOLLOWLOCATION, 1L);
    curl_easy_setopt(easy_.get(), CURLOPT_MAXREDIRS, kRedirections);
    curl_easy_setopt(easy_.get(), CURLOPT_CONNECTTIMEOUT_MS, kConnectTime);
    curl_easy_setopt(easy_.get(), CURLOPT_TIMEOUT_MS, kWholeTime);
    curl_easy_setopt(easy_.get(), CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(easy_.get(), CURLOPT_USERAGENT, "behaviourlinks");
    curl_easy_setopt(easy_.get(), CURLOPT_WRITEFUNCTION, Page::take);
  }

  // The page, or why there is none. Ends early where the end is asked for.
  Result<Page> ask(const Endpoint& endpoint) {
    Page page;
    curl_easy_setopt(easy_.get(), CURLOPT_WRITEDATA, &page);
    curl_multi_add_handle(multi_.get(), easy_.get());
    int running = 1;
    while (running > 0 && !endpoint.is_ending() && curl_multi_perform(multi_.get(), &running) == CURLM_OK)
      if (running > 0) curl_multi_poll(multi_.get(), nullptr, 0, kHttpSlice, nullptr);
    CURLcode code = CURLE_ABORTED_BY_CALLBACK;
    int left = 0;
    while (const CURLMsg* message = curl_multi_info_read(multi_.get(), &left))
      if (message->msg == CURLMSG_DONE) code = message->data.result;
    curl_multi_remove_handle(multi_.get(), easy_.get());
    if (page.is_too_long) return page;
    if (code != CURLE_OK) return Error{ErrorCode::io, "", reason(code)};
    long status = 0;
    curl_easy_getinfo(easy_.get(), CURLINFO_RESPONSE_CODE, &status);
    if (status < 200 || status > 299)
      return Error{ErrorCode::io, "", "the server answers with the status " + std::to_string(status) + " instead of a page"};
    return page;
  }

 private:
  static std::string reason(CURLcode code) {
    switch (code) {
      case CURLE_COULDNT_RESOLVE_HOST: return "no host of that name is known";
      case CURLE_COULDNT_CONNECT: return "the server refuses the connection: nothing listens there";
      case CURLE_OPERATION_TIMEDOUT: return "the server does not answer in time";
      case CURLE_TOO_MANY_REDIRECTS: return "the server sends from page to page without end";
      case CURLE_GOT_NOTHING: return "the server closes the connection without an answer";
      default: return std::string("the page could not be read: ") + curl_easy_strerror(code);
    }
  }

  std::unique_ptr<CURL, decltype(&curl_easy_cleanup)> easy_;
  std::unique_ptr<CURLM, decltype(&curl_multi_cleanup)> multi_;
};

}  // namespace

void run_http(Endpoint& endpoint) {
  static const HttpLibrary kLibrary;
  Client client(endpoint.subscribers().front().path);
  while (!endpoint.is_ending()) {
    const Subscriber subscriber = endpoint.subscribers().front();  // its period may change
    const auto page = client.ask(endpoint);
    if (endpoint.is_ending()) return;
    if (!page) {
      endpoint.fail(page.error().message);
      continue;
    }
    endpoint.succeed();
    if (page->is_too_long)
      subscriber.station->problem("the page is longer than the " + std::to_string(kLongestPayload) + " bytes that are read");
    else subscriber.station->message(page->text);
    endpoint.wait_for_work(subscriber.period);
  }
}

}  // namespace bl::live
