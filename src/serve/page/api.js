// The server's REST interface (/openapi.json).

/** An answer that is not 2xx. `message` is the server's own line. */
export class ApiError extends Error {
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

export class Api {
  #token = "";

  set token(token) {
    this.#token = token;
  }

  model() {
    return this.#ask("/v1/model");
  }

  /** `fields`: the query, such as {grid: "even"}. `depth` may be null. */
  predict(image, depth, fields) {
    const form = new FormData();
    form.append("image", image, "image");
    if (depth) form.append("depth", depth, "depth");
    for (const [name, value] of Object.entries(fields)) form.append(name, value);
    return this.#ask("/v1/predict", { method: "POST", body: form });
  }

  cameraPose(pose, place) {
    const query = new URLSearchParams({ theta_deg: pose.theta_deg, phi_deg: pose.phi_deg, ...place });
    return this.#ask(`/v1/camera-pose?${query}`);
  }

  async #ask(path, options = {}) {
    const headers = this.#token ? { Authorization: `Bearer ${this.#token}` } : {};
    let response;
    try {
      response = await fetch(path, { ...options, headers });
    } catch {
      throw new ApiError(0, "The server does not answer. Is svnet-serve still running?");
    }
    const answer = await response.json().catch(() => ({}));
    if (!response.ok) throw new ApiError(response.status, answer.error ?? `The server answered ${response.status}.`);
    return answer;
  }
}
