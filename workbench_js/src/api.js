// Questions to the server, all about the session of this page.

export class Refused extends Error {}

let session = "";
const prefix = () => `${window.path_prefix ?? ""}/api/${session}`;

export function useSession(key) { session = key; }

async function answered(response) {
  if (response.ok) return response;
  const body = await response.json().catch(() => ({}));
  const error = new Refused(body.error ?? `the server answered ${response.status}`);
  error.status = response.status;
  throw error;
}

export async function ask(path, signal) {
  return (await answered(await fetch(prefix() + path, { signal }))).json();
}

export async function askBytes(path, signal) {
  return (await answered(await fetch(prefix() + path, { signal }))).arrayBuffer();
}

export async function askText(key, fresh = false) {
  const address = `${prefix()}/text?key=${encodeURIComponent(key)}${fresh ? "&fresh" : ""}`;
  const response = await answered(await fetch(address));
  return {
    text: await response.text(),
    version: Number(response.headers.get("x-version")),
    changed: response.headers.get("x-changed") === "1",
  };
}

export async function tell(path, body = {}) {
  const options = {
    method: "POST", body: JSON.stringify(body), headers: { "content-type": "application/json" },
  };
  return (await answered(await fetch(prefix() + path, options))).json();
}
