// The module of films, vorocl_films.so: FFmpeg's libraries encode them.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <memory>

#include "formats/modules.hpp"

namespace vorocl::command {

namespace {

/// Films are the same on every machine: x264 makes other bytes with another number of threads.
constexpr int encoder_threads = 4;

struct Free {
  void operator()(AVFormatContext* file) const {
    avio_closep(&file->pb);
    avformat_free_context(file);
  }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* conversion) const { sws_freeContext(conversion); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

/// After a failure it does nothing more, and the file stays without its end.
class Encoder : public FilmEncoder {
 public:
  Encoder(const std::string& path, double frames_per_second, const cv::Size& size)
      : fails_(!open_codec(frames_per_second, size) || !open_file(path) || !open_picture(size)) {}

  bool is_open() const { return !fails_; }

  bool add(const cv::Mat& picture) override {
    fails_ = fails_ || !convert(picture) || !encode(frame_.get());
    ++frame_->pts;
    return !fails_;
  }

  bool finish() override {
    return !fails_ && encode(nullptr) && av_write_trailer(file_.get()) == 0 && avio_closep(&file_->pb) >= 0;
  }

 private:
  bool open_codec(double frames_per_second, const cv::Size& size) {
    const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_H264);
    codec_.reset(avcodec_alloc_context3(encoder));
    if (encoder == nullptr || !codec_) return false;
    constexpr int finest_rate = 100000;
    codec_->framerate = av_d2q(frames_per_second, finest_rate);
    codec_->time_base = av_inv_q(codec_->framerate);
    codec_->width = size.width;
    codec_->height = size.height;
    codec_->pix_fmt = AV_PIX_FMT_YUV420P;
    codec_->color_range = AVCOL_RANGE_MPEG;  // and these, as libswscale converts
    codec_->colorspace = AVCOL_SPC_SMPTE170M;
    codec_->thread_count = encoder_threads;
    codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
    // The tools of the Baseline profile: arithmetic coding takes about half of the time, and pictures between
    // two others take long to choose. Without the transform of 8 x 8 pixels, flat cells with sharp borders
    // have a smaller error, so that the rate factor may be larger.
    codec_->max_b_frames = 0;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "preset", "superfast", 0);
    av_dict_set(&options, "crf", "21.4", 0);
    av_dict_set(&options, "x264-params", "8x8dct=0:cabac=0:weightp=0", 0);
    const int code = avcodec_open2(codec_.get(), encoder, &options);
    av_dict_free(&options);  // what an encoder other than x264 does not know
    return code == 0;
  }

  bool open_file(const std::string& path) {
    AVFormatContext* file = nullptr;
    avformat_alloc_output_context2(&file, nullptr, "mp4", nullptr);
    if (file == nullptr) return false;
    file_.reset(file);
    file->flags |= AVFMT_FLAG_BITEXACT;
    AVStream* const stream = avformat_new_stream(file, nullptr);
    if (stream == nullptr || avcodec_parameters_from_context(stream->codecpar, codec_.get()) < 0)
      return false;
    stream->time_base = codec_->time_base;
    stream->avg_frame_rate = codec_->framerate;
    const std::string url = "file:" + path;  // else the first colon of a name would end that of a protocol
    return avio_open(&file->pb, url.c_str(), AVIO_FLAG_WRITE) >= 0 &&
           avformat_write_header(file, nullptr) >= 0;
  }

  bool open_picture(const cv::Size& size) {
    packet_.reset(av_packet_alloc());
    frame_.reset(av_frame_alloc());
    if (!packet_ || !frame_) return false;
    frame_->format = codec_->pix_fmt;
    frame_->width = size.width;
    frame_->height = size.height;
    frame_->pts = 0;
    conversion_.reset(sws_getContext(size.width, size.height, AV_PIX_FMT_BGR24, size.width, size.height,
                                     codec_->pix_fmt, SWS_BICUBIC, nullptr, nullptr, nullptr));
    return conversion_ && av_frame_get_buffer(frame_.get(), 0) == 0;
  }

  bool convert(const cv::Mat& picture) {
    const std::uint8_t* const rows[] = {picture.data};
    const int row_bytes[] = {static_cast<int>(picture.step)};
    return av_frame_make_writable(frame_.get()) == 0 &&
           sws_scale(conversion_.get(), rows, row_bytes, 0, picture.rows, frame_->data, frame_->linesize) ==
               picture.rows;
  }

  /// Hands a picture to the encoder, or none, at the end; writes what comes out.
  bool encode(const AVFrame* frame) {
    if (avcodec_send_frame(codec_.get(), frame) < 0) return false;
    for (;;) {
      const int code = avcodec_receive_packet(codec_.get(), packet_.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return true;
      if (code < 0) return false;
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), codec_->time_base, file_->streams[0]->time_base);
      if (av_interleaved_write_frame(file_.get(), packet_.get()) < 0) return false;
    }
  }

  Owned<AVCodecContext> codec_;
  Owned<AVFormatContext> file_;
  Owned<AVPacket> packet_;
  Owned<AVFrame> frame_;  // in the encoder's colours; its time is the number of the next picture
  Owned<SwsContext> conversion_;
  bool fails_;
};

std::unique_ptr<FilmEncoder> open_film(const std::string& path, double frames_per_second,
                                       const cv::Size& size) {
  av_log_set_level(AV_LOG_QUIET);  // what goes wrong is said in our words
  auto encoder = std::make_unique<Encoder>(path, frames_per_second, size);
  if (!encoder->is_open()) return nullptr;
  return encoder;
}

}  // namespace

}  // namespace vorocl::command

/// What modules.cpp asks for, by this name.
extern "C" __attribute__((visibility("default"))) const void* vorocl_module() {
  static const vorocl::command::FilmOpener opener = vorocl::command::open_film;
  return &opener;
}
