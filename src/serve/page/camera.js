// Pictures from the device's camera.

/** Shows a camera in a video element and takes pictures of it. */
export class Camera {
  #video;
  #stream = null;

  constructor(video) {
    this.#video = video;
    video.muted = video.playsInline = true;
  }

  /** Throws Error with a sentence for the user if there is no camera or no permission. */
  async open() {
    if (!navigator.mediaDevices) throw new Error("Browsers give the camera only to pages from this machine or over HTTPS.");
    try {
      this.#stream = await navigator.mediaDevices.getUserMedia({ video: { facingMode: "environment" } });
    } catch (problem) {
      throw new Error(problem.name === "NotAllowedError" ? "The browser was not allowed to use the camera."
                                                         : "There is no camera that the browser can use.");
    }
    this.#video.srcObject = this.#stream;
    await this.#video.play();
  }

  /** The picture of now as a PNG file. */
  take() {
    const canvas = document.createElement("canvas");
    canvas.width = this.#video.videoWidth;
    canvas.height = this.#video.videoHeight;
    canvas.getContext("2d").drawImage(this.#video, 0, 0);
    return new Promise((done) => canvas.toBlob(done, "image/png"));
  }

  close() {
    this.#stream?.getTracks().forEach((track) => track.stop());
    this.#stream = null;
    this.#video.srcObject = null;
  }
}
