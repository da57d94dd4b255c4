// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>  // before Asio, which lacks it in C++20

#include <openssl/pem.h>
#include <openssl/x509.h>
#include <unistd.h>

#include <boost/asio/ssl.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <cstring>
#include <filesystem>
#include <memory>

#include "skein/layer/hmi/serve/web_server.h"

namespace skein::hmi::tls_test {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace ssl = boost::asio::ssl;
using tcp = boost::asio::ip::tcp;

// A certificate for this machine that signs itself, with its key, in one file.
std::string make_certificate() {
  const auto file = std::filesystem::temp_directory_path() /
                    ("skein-tls-" + std::to_string(::getpid()) + ".pem");
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(EVP_RSA_gen(2048),
                                                                EVP_PKEY_free);
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(X509_new(), X509_free);
  X509_set_version(certificate.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -3600);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), 3600);
  X509_set_pubkey(certificate.get(), key.get());
  X509_NAME* name = X509_get_subject_name(certificate.get());
  const unsigned char localhost[] = "localhost";
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, localhost, -1, -1, 0);
  X509_set_issuer_name(certificate.get(), name);
  X509_sign(certificate.get(), key.get(), EVP_sha256());
  const std::unique_ptr<BIO, decltype(&BIO_free_all)> out(BIO_new_file(file.c_str(), "w"),
                                                          BIO_free_all);
  PEM_write_bio_X509(out.get(), certificate.get());
  PEM_write_bio_PrivateKey(out.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  return file;
}

class Echo final : public WebListener {
 public:
  HttpAnswer answer(const HttpRequest& request) override {
    HttpAnswer answer;
    answer.body = std::make_shared<const std::string>(request.path);
    return answer;
  }
  void joined(ClientNumber client, const Access&, std::string_view) override {
    const std::string hello = "hello";
    auto bytes = std::make_shared<std::vector<std::byte>>(hello.size());
    std::memcpy(bytes->data(), hello.data(), hello.size());
    server->send(client, bytes, true);
  }
  void said(ClientNumber, std::string_view, bool) override {}
  void left(ClientNumber) override {}
  WebServer* server = nullptr;
};

class ServedByTls : public testing::Test {
 protected:
  ServedByTls() : file_(make_certificate()) {
    WebOptions options;
    options.port = 0;
    options.protocols = {"echo"};
    options.certificate_file = options.key_file = file_;
    options.access =
        AccessTable::parse("operator-operator-1 operator Anna\n", "").value();
    auto opened = WebServer::open(options, echo_);
    EXPECT_TRUE(opened) << opened.error().text();
    server_ = std::move(opened).value();
    echo_.server = server_.get();
    server_->start();
    EXPECT_EQ(server_->place().find("https://"), 0u);
    client_.load_verify_file(file_);
    client_.set_verify_mode(ssl::verify_peer);
  }
  ~ServedByTls() override {
    server_.reset();
    std::filesystem::remove(file_);
  }

  template <class Stream>
  void connect(Stream& stream) {
    const std::string place = server_->place();
    const auto port =
        static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
    beast::get_lowest_layer(stream).connect(
        tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), port));
  }

  std::string file_;
  Echo echo_;
  std::unique_ptr<WebServer> server_;
  boost::asio::io_context io_;
  ssl::context client_{ssl::context::tls_client};
};

TEST_F(ServedByTls, WhoTrustsTheCertificateIsAnsweredAndLoggedInByASecureCookie) {
  ssl::stream<beast::tcp_stream> stream(io_, client_);
  connect(stream);
  stream.handshake(ssl::stream_base::client);
  http::request<http::string_body> request(http::verb::post, "/login", 11);
  request.set(http::field::host, "localhost");
  request.body() = R"({"token": "operator-operator-1"})";
  request.prepare_payload();
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(stream, buffer, response);
  EXPECT_EQ(response.result_int(), 204U);
  const std::string cookie(response[http::field::set_cookie]);
  EXPECT_NE(cookie.find("Secure"), std::string::npos) << cookie;
}

TEST_F(ServedByTls, WebSocketsAreCarriedToo) {
  beast::websocket::stream<ssl::stream<beast::tcp_stream>> socket(io_, client_);
  connect(socket);
  socket.next_layer().handshake(ssl::stream_base::client);
  socket.set_option(beast::websocket::stream_base::decorator(
      [](beast::websocket::request_type& request) {
        request.set(http::field::sec_websocket_protocol, "echo");
        request.set(http::field::authorization, "Bearer operator-operator-1");
      }));
  socket.handshake("localhost", "/live");
  beast::flat_buffer buffer;
  socket.read(buffer);
  EXPECT_EQ(beast::buffers_to_string(buffer.data()), "hello");
}

TEST_F(ServedByTls, WhoSpeaksWithoutTlsOrTrustsOthersHearsNothing) {
  beast::tcp_stream plain(io_);
  connect(plain);
  http::request<http::empty_body> request(http::verb::get, "/", 11);
  request.set(http::field::host, "localhost");
  http::write(plain, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  beast::error_code failure;
  http::read(plain, buffer, response, failure);
  EXPECT_TRUE(failure);

  ssl::context strict(ssl::context::tls_client);
  strict.set_verify_mode(ssl::verify_peer);
  ssl::stream<beast::tcp_stream> stream(io_, strict);
  connect(stream);
  stream.handshake(ssl::stream_base::client, failure);
  EXPECT_TRUE(failure);
}

}  // namespace
}  // namespace skein::hmi::tls_test
