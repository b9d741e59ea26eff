// English, which is part of the page's script: every other language comes when somebody reads it.
import { add_table, set_language } from "./words";
import { en } from "./words/en";

add_table("en", en);
set_language("en");
