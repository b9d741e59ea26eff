// The minutes as a page, for who leads and for those with whom they were shared.
import type { JSX } from "preact";
import { kMinutes, minutes_form, zone_here } from "../minutes";
import { Icon } from "../parts";
import type { Session } from "../session";

// A page of its own, which the browser asks for as for any form. It is not taken from memory, because the policy of this page would
// forbid its style.
export function OpenMinutes({ s, children }: { s: Session; children: string }): JSX.Element {
  const form = minutes_form(s.views.room.code ?? "", s.connection.token ?? "", kMinutes.page, zone_here());
  return (
    <form method="post" action="/minutes" target="_blank">
      {Object.entries(form).map(([name, value]) => (
        <input key={name} type="hidden" name={name} value={value} />
      ))}
      <button class="main">
        {children}
        <Icon name="right" />
      </button>
    </form>
  );
}
