# Completion of touchstone for bash.
_touchstone() {
    local cur prev command word
    cur=${COMP_WORDS[COMP_CWORD]}
    prev=${COMP_WORDS[COMP_CWORD - 1]}
    command=run
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case $word in run | scan | track | calibrate | record | bench | check | notice | reset) command=$word ;; esac
    done
    case $prev in
        --pace) mapfile -t COMPREPLY < <(compgen -W "live step" -- "$cur"); return ;;
        --display) mapfile -t COMPREPLY < <(compgen -W "headless window projector" -- "$cur"); return ;;
        --scene) mapfile -t COMPREPLY < <(compgen -W "paint particles mirror photos inspect attract" -- "$cur"); return ;;
        --method) mapfile -t COMPREPLY < <(compgen -W "graycode touch" -- "$cur"); return ;;
        --config | --events | --scan | --mesh | --trajectory | --json) mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --maps | --shots) mapfile -t COMPREPLY < <(compgen -d -- "$cur"); return ;;
        --sensor) mapfile -t COMPREPLY < <(compgen -f -W "seq: sim:flat sim:curved sim:cluttered sim:bowl sim:mixed sim:room" -- "$cur"); return ;;
    esac
    local camera="--help --sensor --pace --config --frames" words
    local source="$camera --voxels --side"
    case $command in
        run) words="$source --display --scene --events --maps --shots --keep-nothing --print-config" ;;
        scan) words="$source --scan --mesh" ;;
        track) words="$source --trajectory --scan --mesh" ;;
        calibrate) words="${source/--frames /} --method --display --json" ;;
        record) words="$camera --color" ;;
        bench) words="$source --moving --json --display" ;;
        check) words="--help --json --config" ;;
        notice) words="--help --config --display --seconds" ;;
        reset) words="--help --config" ;;
    esac
    if [[ $COMP_CWORD == 1 && $cur != -* ]]; then words="run scan track calibrate record bench check notice reset"; fi
    [[ $COMP_CWORD == 1 && $cur == -* ]] && words+=" --version"
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
    [[ $command == record && $cur != -* ]] && mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$cur")
    return 0
}
complete -F _touchstone touchstone
