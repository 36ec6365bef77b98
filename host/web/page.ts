// The page of `unicursal serve`. The token comes in the fragment of the address, which reaches no log.

const fragment = new URLSearchParams(location.hash.slice(1));
const given = fragment.get("token");
if (given) {
  localStorage.setItem("token", given);
  history.replaceState(null, "", location.pathname);
}

async function words(): Promise<Record<string, string>> {
  const language = navigator.language.startsWith("de") ? "de" : "en";
  return (await fetch(`/assets/${language}.json`)).json();
}

async function show(): Promise<void> {
  const texts = await words();
  const answer = await fetch("/api/status", {
    headers: { Authorization: `Bearer ${localStorage.getItem("token") ?? ""}` },
  });
  const status = await answer.json();
  const place = document.querySelector("[role=status]");
  if (place) place.textContent = answer.ok ? `${texts["status.state"]}: ${status.state}` : status.error;
}

void show();
