// Requests to the daemon. The token came in the fragment of the address, or was typed in; it is kept in
// localStorage and sent as a header. Pictures are asked for with the cookie of `POST /api/login`.
import type {Right} from './types';

export class ApiError extends Error {
  constructor(
      message: string, readonly status: number, readonly code: string,
      readonly detail: Record<string, unknown> = {}) {
    super(message);
  }
}

export const access = {
  token: '',
  right: 'all' as Right,
  name: '',

  /** Takes a token out of the address, which then no longer shows it. */
  begin(): void {
    const given = /^#token=(.+)$/.exec(location.hash);
    if (given) {
      localStorage.setItem('token', decodeURIComponent(given[1]));
      history.replaceState(null, '', location.pathname);
    }
    this.token = localStorage.getItem('token') ?? '';
  },

  use(token: string): void {
    this.token = token.trim();
    localStorage.setItem('token', this.token);
  },

  forget(): void {
    this.token = '';
    localStorage.removeItem('token');
  },

  may(right: Right): boolean {
    const order: Right[] = ['watch', 'queue', 'steer', 'all'];
    return order.indexOf(this.right) >= order.indexOf(right);
  },
};

interface Options {
  body?: unknown;
  limit?: number
}

async function send(method: string, path: string, options: Options = {}): Promise<Response> {
  const headers: Record<string, string> = {};
  if (access.token) headers['Authorization'] = `Bearer ${access.token}`;
  let body: string|undefined;
  if (options.body !== undefined) {
    body = JSON.stringify(options.body);
    headers['Content-Type'] = 'application/json';
  }
  const stop = new AbortController();
  const timer = options.limit ? window.setTimeout(() => stop.abort(), options.limit) : 0;
  try {
    const response = await fetch(path, {method, headers, body, signal: stop.signal, cache: 'no-store'});
    if (!response.ok) throw await refusal(response);
    return response;
  } finally {
    window.clearTimeout(timer);
  }
}

async function refusal(response: Response): Promise<ApiError> {
  return refusalOf(response.status, response.statusText, await response.text().catch(() => ''));
}

function refusalOf(status: number, statusText: string, body: string): ApiError {
  let answer: Record<string, unknown> = {};
  try {
    answer = JSON.parse(body) ?? {};
  } catch {
    // An answer without a sentence: a proxy's, perhaps.
  }
  const sentence = typeof answer.error === 'string' ? answer.error : `${status} ${statusText}`;
  return new ApiError(sentence, status, typeof answer.code === 'string' ? answer.code : '', answer);
}

/** Hears how many bytes of a body have left this device. */
export type Sent = (bytes: number) => void;

/** As json(), and says how far it is, which fetch() does not. */
function transfer<T>(method: string, path: string, body: Blob|FormData, sent: Sent): Promise<T> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open(method, path);
    if (access.token) request.setRequestHeader('Authorization', `Bearer ${access.token}`);
    if (!(body instanceof FormData)) request.setRequestHeader('Content-Type', 'application/octet-stream');
    request.upload.onprogress = (event) => sent(event.loaded);
    request.onerror = request.onabort = () => reject(new TypeError('the connection has failed'));
    request.onload = () => {
      const good = request.status >= 200 && request.status < 300;
      if (!good) return reject(refusalOf(request.status, request.statusText, request.responseText));
      resolve(JSON.parse(request.responseText || '{}'));
    };
    request.send(body);
  });
}

async function json<T>(method: string, path: string, options: Options = {}): Promise<T> {
  const response = await send(method, path, options);
  return response.status === 204 ? ({} as T) : await response.json();
}

export const api = {
  get: <T>(path: string, limit = 20_000) => json<T>('GET', path, {limit}),
  post: <T = unknown>(path: string, body: unknown = {}) => json<T>('POST', path, {body}),
  put: <T = unknown>(path: string, body: unknown) => json<T>('PUT', path, {body}),
  remove: <T = unknown>(path: string) => json<T>('DELETE', path),
  bytes: async (path: string) => (await send('GET', path, {limit: 30_000})).arrayBuffer(),
  form: <T = unknown>(path: string, form: FormData, sent: Sent) => transfer<T>('POST', path, form, sent),
  upload: <T = unknown>(path: string, file: Blob, sent: Sent) => transfer<T>('PUT', path, file, sent),

  /** Learns what the token may do, and gets the cookie for pictures. Older daemons do not answer that. */
  async login(): Promise<void> {
    if (!access.token) return;
    try {
      const answer = await api.post<{name?: string; right?: Right}>('/api/login', {token: access.token});
      if (answer.right) access.right = answer.right;
      access.name = answer.name ?? '';
    } catch (error) {
      if (!(error instanceof ApiError) || error.status === 401) throw error;
    }
  },

  socket(): WebSocket {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const protocols = ['unicursal.v1'];
    if (access.token) protocols.push(`token.${access.token}`);
    return new WebSocket(`${scheme}://${location.host}/api/events`, protocols);
  },
};
